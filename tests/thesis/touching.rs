//! Bodies that merely touch are chamfered each on its own.

use chamfer::shapes::{self, Touch};
use chamfer::{Outcome, TriangleKind};

use crate::{chamfered, count, vector};

const ALL: [Touch; 4] = [Touch::Vertex, Touch::Edge, Touch::HalfEdge, Touch::Face];

#[test]
fn two_cubes_that_touch_become_two_chamfered_cubes() {
    for touch in ALL {
        let result = chamfered(&shapes::two_cubes_touching(touch), 0.1);
        assert_eq!(result.mesh.positions.len(), 2 * 24, "{touch:?}");
        assert_eq!(result.mesh.indices.len() / 3, 2 * 44, "{touch:?}");
        assert_eq!(count(&result, TriangleKind::Corner), 2 * 8, "{touch:?}");
        let is_full = |outcome: Outcome| outcome == Outcome::Full;
        assert!(result.verdicts.iter().all(|v| is_full(v.outcome)), "{touch:?}");
    }
}

#[test]
fn a_cube_that_touches_another_is_chamfered_as_if_alone() {
    let mut alone = shapes::plain_cube(1.0);
    for position in &mut alone.positions {
        *position = position.map(|along| along + 0.5);
    }
    let alone = chamfered(&alone, 0.1);
    for touch in ALL {
        let result = chamfered(&shapes::two_cubes_touching(touch), 0.1);
        let pairs = alone.mesh.positions.iter().zip(&result.mesh.positions);
        for (&expected, &found) in pairs {
            assert!(vector(expected).distance(vector(found)) < 1e-6, "{touch:?}");
        }
    }
}
