//! Triangle lists, strips and fans, all as lists.

/// How a primitive's vertices form triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    List,
    Strip,
    Fan,
}

impl Mode {
    /// The mode of a glTF code; `None` for points, lines and what glTF does not have.
    pub fn of_code(code: usize) -> Option<Mode> {
        match code {
            4 => Some(Mode::List),
            5 => Some(Mode::Strip),
            6 => Some(Mode::Fan),
            _ => None,
        }
    }

    /// `#triangles by 3`, flattened. What is left over at the end of a list forms no triangle.
    /// `restart` is no vertex: what follows it begins anew.
    pub fn to_list(self, indices: Vec<u32>, restart: u32) -> Vec<u32> {
        if !indices.contains(&restart) {
            return self.run_to_list(indices);
        }
        let runs = indices.split(|index| *index == restart);
        runs.flat_map(|run| self.run_to_list(run.to_vec())).collect()
    }

    fn run_to_list(self, indices: Vec<u32>) -> Vec<u32> {
        match self {
            Mode::List => whole_triangles(indices),
            Mode::Strip => with_area(indices.windows(3).enumerate().map(strip_triangle)),
            Mode::Fan => {
                let Some((first, rest)) = indices.split_first() else { return Vec::new() };
                with_area(rest.windows(2).map(|pair| [pair[0], pair[1], *first]))
            }
        }
    }
}

fn whole_triangles(mut indices: Vec<u32>) -> Vec<u32> {
    indices.truncate(indices.len() / 3 * 3);
    indices
}

fn strip_triangle((place, window): (usize, &[u32])) -> [u32; 3] {
    match place % 2 {
        0 => [window[0], window[1], window[2]],
        _ => [window[0], window[2], window[1]],
    }
}

/// Strips are joined by triangles that repeat a vertex; they are no part of the surface.
fn with_area(triangles: impl Iterator<Item = [u32; 3]>) -> Vec<u32> {
    triangles.filter(|[a, b, c]| a != b && b != c && c != a).flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const NONE: u32 = u32::MAX;

    #[test]
    fn strips_and_fans_begin_anew_after_a_restart() {
        let indices = vec![0, 1, 2, 9, 3, 4, 5, 6];
        assert_eq!(Mode::Strip.to_list(indices.clone(), 9), [0, 1, 2, 3, 4, 5, 4, 6, 5]);
        assert_eq!(Mode::Fan.to_list(indices.clone(), 9), [1, 2, 0, 4, 5, 3, 5, 6, 3]);
        assert_eq!(Mode::List.to_list(indices, 9), [0, 1, 2, 3, 4, 5]);
    }

    #[test]
    fn a_strip_turns_every_other_triangle() {
        //  1---3        the second triangle keeps the winding of the first
        //  | \ | \
        //  0---2---4
        assert_eq!(Mode::Strip.to_list(vec![0, 1, 2, 3, 4], NONE), [0, 1, 2, 1, 3, 2, 2, 3, 4]);
    }

    #[test]
    fn a_strip_drops_its_joints() {
        assert_eq!(Mode::Strip.to_list(vec![0, 1, 2, 2, 3, 3, 4, 5], NONE), [0, 1, 2, 3, 5, 4]);
    }

    #[test]
    fn a_fan_turns_about_its_first_vertex() {
        assert_eq!(Mode::Fan.to_list(vec![7, 1, 2, 3], NONE), [1, 2, 7, 2, 3, 7]);
    }

    #[test]
    fn short_lists_have_no_triangle() {
        for mode in [Mode::List, Mode::Strip, Mode::Fan] {
            assert!(mode.to_list(vec![], NONE).is_empty());
            assert!(mode.to_list(vec![1, 2], NONE).is_empty());
        }
    }
}
