//! Small triangle nets from arbitrary bytes: points and indices, without normals.

use arbitrary::Arbitrary;

/// How many points and triangles a shape has at most: finds are small, and time is better spent on
/// many shapes than on large ones.
const MOST: usize = 96;

/// Points and the triangles over them.
#[derive(Debug, Default)]
pub struct Net {
    /// `#points by 3`.
    pub points: Vec<[f32; 3]>,
    /// `#triangles by 3`.
    pub indices: Vec<u32>,
}

/// What a net is made of.
#[derive(Arbitrary, Debug)]
pub enum Shape {
    /// Triangles at random over few points of a coarse grid: whatever can go wrong, does.
    Soup(Vec<[i8; 3]>, Vec<[u8; 3]>),
    /// The same over a fine grid, so that hardly anything is coplanar or aligned.
    Fine(Vec<[i16; 3]>, Vec<[u8; 3]>),
    /// A terrain: its width, its heights, and the diagonals of its cells.
    Field(u8, Vec<i8>, u64),
    /// The outside of unit cubes on a grid of three by three by three, and their diagonals.
    Blocks(u32, u64),
    /// A fan around an apex, open or closed, with a floor or without.
    Fan(Vec<[i8; 2]>, i8, bool, bool),
    /// Faces around one edge.
    Book(Vec<[i8; 2]>),
    /// A band of quads that is turned over so many times before its ends meet.
    Band(u8, i8, i8),
    /// A prism over an outline; its caps are fans around the first corner.
    Prism(Vec<[i8; 2]>, i8),
}

impl Shape {
    /// The net of the shape.
    pub fn net(&self) -> Net {
        match self {
            Shape::Soup(points, triangles) => {
                soup(points.iter().map(|p| p.map(|along| f32::from(along % 4))), triangles)
            }
            Shape::Fine(points, triangles) => {
                soup(points.iter().map(|p| p.map(|along| f32::from(along) / 4096.0)), triangles)
            }
            Shape::Field(width, heights, diagonals) => field(*width, heights, *diagonals),
            Shape::Blocks(filled, diagonals) => blocks(*filled, *diagonals),
            Shape::Fan(rim, apex, closed, floor) => fan(rim, *apex, *closed, *floor),
            Shape::Book(pages) => book(pages),
            Shape::Band(steps, turns, width) => band(*steps, *turns, *width),
            Shape::Prism(outline, height) => prism(outline, *height),
        }
    }
}

fn soup(points: impl Iterator<Item = [f32; 3]>, triangles: &[[u8; 3]]) -> Net {
    let points: Vec<_> = points.take(MOST).collect();
    if points.is_empty() {
        return Net::default();
    }
    let corners = triangles.iter().take(MOST).flatten();
    let indices = corners.map(|&corner| u32::from(corner) % points.len() as u32).collect();
    Net { points, indices }
}

fn field(width: u8, heights: &[i8], diagonals: u64) -> Net {
    let columns = 2 + usize::from(width % 6);
    let heights = &heights[..heights.len().min(MOST) / columns * columns];
    let at = |(place, height): (usize, &i8)| {
        [(place % columns) as f32, f32::from(height % 8) / 4.0, (place / columns) as f32]
    };
    let mut net = Net { points: heights.iter().enumerate().map(at).collect(), indices: Vec::new() };
    for row in 1..heights.len() / columns {
        for column in 1..columns {
            let [d, a] = [row, row - 1].map(|row| (row * columns + column - 1) as u32);
            net.quad([a, d, d + 1, a + 1], bit(diagonals, row * columns + column));
        }
    }
    net
}

fn bit(bits: u64, place: usize) -> bool {
    bits >> (place % 64) & 1 == 1
}

impl Net {
    fn quad(&mut self, [a, b, c, d]: [u32; 4], diagonal: bool) {
        self.indices.extend(if diagonal { [a, b, c, a, c, d] } else { [b, c, d, b, d, a] });
    }

    /// A quad over points of its own: they are told apart by nothing but their vertices.
    fn loose_quad(&mut self, points: [[f32; 3]; 4], diagonal: bool) {
        let first = self.points.len() as u32;
        self.points.extend(points);
        self.quad([0, 1, 2, 3].map(|corner| first + corner), diagonal);
    }
}

fn blocks(filled: u32, diagonals: u64) -> Net {
    let is_filled = |at: [i32; 3]| {
        at.iter().all(|along| (0..3).contains(along))
            && filled >> (at[0] + 3 * at[1] + 9 * at[2]) & 1 == 1
    };
    let mut net = Net::default();
    for cell in (0..27).map(|k| [k % 3, k / 3 % 3, k / 9]).filter(|&cell| is_filled(cell)) {
        for (axis, step) in [(0, -1), (0, 1), (1, -1), (1, 1), (2, -1), (2, 1)] {
            let mut beside = cell;
            beside[axis] += step;
            if !is_filled(beside) {
                let sides = net.points.len() / 4;
                net.loose_quad(cube_side(cell, axis, step), bit(diagonals, sides));
            }
        }
    }
    net
}

/// One side of a unit cube, wound outward.
fn cube_side(cell: [i32; 3], axis: usize, step: i32) -> [[f32; 3]; 4] {
    let mut quad = [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[right, up]| {
        let mut at = cell;
        at[axis] += i32::from(step > 0);
        at[(axis + 1) % 3] += right;
        at[(axis + 2) % 3] += up;
        at.map(|along| along as f32)
    });
    if step < 0 {
        quad.reverse();
    }
    quad
}

fn fan(rim: &[[i8; 2]], apex: i8, closed: bool, floor: bool) -> Net {
    let rim = &rim[..rim.len().min(MOST)];
    let count = rim.len() as u32;
    let mut points: Vec<_> = rim.iter().map(|&[x, z]| [f32::from(x), 0.0, f32::from(z)]).collect();
    points.extend([[0.0, f32::from(apex), 0.0], [0.0; 3]]);
    let mut indices = Vec::new();
    for a in 0..if closed { count } else { count.saturating_sub(1) } {
        let b = (a + 1) % count;
        indices.extend([count, b, a]);
        if floor {
            indices.extend([count + 1, a, b]);
        }
    }
    Net { points, indices }
}

fn book(pages: &[[i8; 2]]) -> Net {
    let pages = &pages[..pages.len().min(MOST)];
    let mut points = vec![[0.0; 3], [0.0, 8.0, 0.0]];
    points.extend(pages.iter().map(|&[x, z]| [f32::from(x), 4.0, f32::from(z)]));
    let page = |number: usize| {
        let outer = number as u32 + 2;
        if number.is_multiple_of(2) { [0, 1, outer] } else { [1, 0, outer] }
    };
    Net { points, indices: (0..pages.len()).flat_map(page).collect() }
}

/// One turn makes a Moebius strip.
fn band(steps: u8, turns: i8, width: i8) -> Net {
    let steps = 3 + usize::from(steps % 30);
    let mut net = Net::default();
    let side = |step: usize| {
        let along = step as f32 / steps as f32 * std::f32::consts::TAU;
        let tilt = along / 2.0 * f32::from(turns % 4);
        [-1.0, 1.0].map(|across| {
            let out = 8.0 + across * tilt.cos() * f32::from(width) / 64.0;
            [out * along.cos(), across * tilt.sin() * f32::from(width) / 64.0, out * along.sin()]
        })
    };
    // The ends meet to the bit, not merely nearly.
    let ends = |step: usize| {
        let [low, high] = side(step % steps);
        if step == steps && turns % 2 != 0 { [high, low] } else { [low, high] }
    };
    for step in 0..steps {
        let ([a, d], [b, c]) = (ends(step), ends(step + 1));
        net.loose_quad([a, b, c, d], step % 2 == 0);
    }
    net
}

fn prism(outline: &[[i8; 2]], height: i8) -> Net {
    let outline = &outline[..outline.len().min(MOST / 2)];
    let count = outline.len() as u32;
    let at = |y: f32| outline.iter().map(move |&[x, z]| [f32::from(x), y, -f32::from(z)]);
    let mut net =
        Net { points: at(0.0).chain(at(f32::from(height))).collect(), indices: Vec::new() };
    for a in 0..count {
        let b = (a + 1) % count;
        net.quad([a, b, b + count, a + count], a % 2 == 0);
        if a > 0 && b > 0 {
            net.indices.extend([0, b, a, count, a + count, b + count]);
        }
    }
    net
}
