//! Scenes that leak, and scenes that do not.

use super::*;

/// Two triangles over four corners, counter-clockwise where seen from outside.
fn quad([a, b, c, d]: [[f32; 3]; 4]) -> [SceneTriangle; 2] {
    [[a, b, c], [a, c, d]]
}

/// A square of half-size `half` around the origin in the plane at `z`, facing +z.
fn square(half: f32, z: f32) -> [SceneTriangle; 2] {
    quad([[-half, -half, z], [half, -half, z], [half, half, z], [-half, half, z]])
}

/// The same with a slit of this width down its middle.
fn slit_square(half: f32, z: f32, slit: f32) -> Vec<SceneTriangle> {
    let edge = slit / 2.0;
    let left = quad([[-half, -half, z], [-edge, -half, z], [-edge, half, z], [-half, half, z]]);
    let right = quad([[edge, -half, z], [half, -half, z], [half, half, z], [edge, half, z]]);
    [left, right].concat()
}

fn found(before: &[SceneTriangle], after: &[SceneTriangle], width: f32) -> usize {
    leaks(before, after, width, Eyes::default()).len()
}

#[test]
fn what_did_not_change_does_not_leak() {
    let wall = square(1.0, 0.0);
    assert_eq!(found(&wall, &wall, 0.01), 0);
}

//  ________      ___ ____
// |        |    |   |    |
// |        | -> |   |    |
// |________|    |___|____|
#[test]
fn a_slit_in_a_wall_leaks() {
    let leaks = leaks(&square(1.0, 0.0), &slit_square(1.0, 0.0, 0.02), 0.01, Eyes::default());
    assert!(!leaks.is_empty());
    assert!(leaks.iter().all(|leak| leak.depth == f32::INFINITY));
    let on_slit = |leak: &Leak| leak.places.iter().all(|place| place[0].abs() < 0.011);
    assert!(leaks.iter().all(on_slit));
}

#[test]
fn a_slit_right_before_another_wall_is_a_groove() {
    let groove = |depth: f32| [slit_square(1.0, 0.0, 0.02), square(1.0, -depth).to_vec()].concat();
    assert_eq!(found(&square(1.0, 0.0), &groove(0.02), 0.01), 0);
    assert_ne!(found(&square(1.0, 0.0), &groove(0.2), 0.01), 0);
}

#[test]
fn an_outline_that_recedes_shows_what_was_beside_it() {
    let floor = square(1.0, -1.0);
    let with = |half: f32| [square(half, 0.0), floor].concat();
    assert_eq!(found(&with(0.5), &with(0.48), 0.01), 0);
    assert_ne!(found(&with(0.5), &with(0.35), 0.01), 0, "far more than a chamfer takes");
}

#[test]
fn backs_are_not_seen() {
    let back = square(1.0, 0.0).map(|[a, b, c]| [a, c, b]);
    let front = square(1.0, 0.1);
    let both = [back, front].concat();
    // From behind there was nothing to see either way.
    assert_eq!(found(&back, &[], 0.01), found(&front, &[], 0.01), "each shows to one side");
    assert_eq!(found(&both, &both, 0.01), 0);
}

#[test]
fn nothing_and_what_is_not_finite_is_left_out() {
    assert_eq!(found(&[], &square(1.0, 0.0), 0.01), 0);
    let wall = square(1.0, 0.0);
    let odd = [wall.to_vec(), vec![[[f32::NAN; 3]; 3], [[f32::INFINITY; 3]; 3]]].concat();
    assert_eq!(found(&odd, &wall, 0.01), 0);
}

/// Numbers from -1 to 1, always the same.
struct Numbers(u32);

impl Numbers {
    fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (self.0 >> 8) as f32 / (1 << 23) as f32 - 1.0
    }

    fn point(&mut self) -> [f32; 3] {
        [0; 3].map(|_| self.next())
    }
}

/// Triangles anywhere, some of which then move a little, some far, and some go.
fn random_scenes(seed: u32) -> [Vec<SceneTriangle>; 2] {
    let mut numbers = Numbers(seed);
    let before: Vec<SceneTriangle> = (0..24).map(|_| [0; 3].map(|_| numbers.point())).collect();
    let moved = before.iter().enumerate().filter_map(|(k, triangle)| {
        let by = [0.0, 0.02, 0.3][k % 3] * numbers.next();
        let moved = triangle.map(|corner| corner.map(|along| along + by));
        (k % 8 != 7).then_some(moved)
    });
    let after = moved.collect();
    [before, after]
}

#[test]
fn random_scenes_leak_where_the_obvious_way_says() {
    let eyes = Eyes { views: 5, resolution: 48, threads: 1 };
    let mut found = 0;
    for seed in 0..4 {
        let [before, after] = random_scenes(seed);
        for width in [0.004, 0.02, 0.06, 0.4] {
            let fast = leaks(&before, &after, width, eyes);
            let slow = reference::leaks(&before, &after, width, eyes);
            let counts = |leaks: Vec<usize>| (leaks.len(), leaks);
            assert_eq!(
                counts(fast.iter().map(|leak| leak.places.len()).collect()),
                counts(slow.iter().map(Vec::len).collect()),
                "seed {seed}, width {width}"
            );
            for (fast, slow) in fast.iter().flat_map(|leak| &leak.places).zip(slow.concat()) {
                let apart = glam::Vec3::from(*fast).distance(glam::Vec3::from(slow));
                assert!(apart < 1e-5, "{fast:?} is {slow:?}, seed {seed}, width {width}");
            }
            found += fast.len();
        }
    }
    assert!(found > 25, "{found} leaks are no test");
}
