//! The nearest of many triangles, as points of nine coordinates (a k-d tree).

/// Three corners, one after the other.
pub(super) type Point = [f32; 9];

/// Triangles that are far from all others are looked for in vain nearly everywhere: after this
/// many, the nearest so far has to do. Where there is a near one, a few dozen lead to it.
const MOST_VISITS: u32 = 1000;

/// A tree over points. The middle of each range of `order` halves it along `axis`; the halves are
/// ranges again.
pub(super) struct NearestTree {
    points: Vec<Point>,
    /// `#points`: their numbers.
    order: Vec<u32>,
    /// `#points`, by place in `order`: the axis along which the range is halved there.
    axis: Vec<u8>,
}

impl NearestTree {
    pub fn new(points: Vec<Point>) -> NearestTree {
        let mut tree = NearestTree {
            order: (0..points.len() as u32).collect(),
            axis: vec![0; points.len()],
            points,
        };
        let mut ranges = vec![(0, tree.order.len())];
        while let Some((start, end)) = ranges.pop() {
            if end - start > 1 {
                let middle = tree.halve(start, end);
                ranges.extend([(start, middle), (middle + 1, end)]);
            }
        }
        tree
    }

    fn halve(&mut self, start: usize, end: usize) -> usize {
        let NearestTree { points, order, axis } = self;
        let middle = (end - start) / 2;
        let order = &mut order[start..end];
        let widest = widest_axis(points, order);
        order.select_nth_unstable_by(middle, |&a, &b| {
            let along = |number: u32| points[number as usize][widest];
            along(a).total_cmp(&along(b)).then(a.cmp(&b))
        });
        axis[start + middle] = widest as u8;
        start + middle
    }

    /// Shows points that are nearer than `limit` (a squared distance) to `visit`, near ones early.
    /// It is told their number, their squared distance and the limit, and returns the limit from
    /// then on.
    pub fn visit_near(
        &self,
        to: &Point,
        mut limit: f64,
        mut visit: impl FnMut(u32, f64, f64) -> f64,
    ) {
        let mut visits = 0;
        let mut ranges = vec![(0, self.order.len(), 0.0)];
        while let Some((start, end, gap)) = ranges.pop() {
            if start == end || gap >= limit || visits == MOST_VISITS {
                continue;
            }
            visits += 1;
            let middle = start + (end - start) / 2;
            let number = self.order[middle];
            let point = &self.points[number as usize];
            let distance = squared_distance(to, point);
            if distance < limit {
                limit = visit(number, distance, limit);
            }
            let axis = usize::from(self.axis[middle]);
            let past = f64::from(to[axis]) - f64::from(point[axis]);
            let (low, high) = ((start, middle), (middle + 1, end));
            let (near, far) = if past < 0.0 { (low, high) } else { (high, low) };
            ranges.push((far.0, far.1, gap.max(past * past)));
            ranges.push((near.0, near.1, gap));
        }
    }
}

fn widest_axis(points: &[Point], order: &[u32]) -> usize {
    let mut low = [f32::INFINITY; 9];
    let mut high = [f32::NEG_INFINITY; 9];
    for &number in order {
        for (axis, &along) in points[number as usize].iter().enumerate() {
            low[axis] = low[axis].min(along);
            high[axis] = high[axis].max(along);
        }
    }
    let width = |axis: &usize| high[*axis] - low[*axis];
    (0..9).max_by(|a, b| width(a).total_cmp(&width(b))).unwrap_or(0)
}

fn squared_distance(one: &Point, other: &Point) -> f64 {
    one.iter().zip(other).map(|(a, b)| (f64::from(*a) - f64::from(*b)).powi(2)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn random_points(count: usize) -> Vec<Point> {
        let mut state = 1u32;
        let mut random = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) as f32 / (1 << 24) as f32
        };
        (0..count).map(|_| [(); 9].map(|()| random())).collect()
    }

    /// The nearest point of those that may be taken.
    fn nearest(
        tree: &NearestTree,
        to: &Point,
        limit: f64,
        may_take: impl Fn(u32) -> bool,
    ) -> Option<u32> {
        let mut best = None;
        tree.visit_near(to, limit, |number, distance, limit| {
            if may_take(number) {
                best = Some(number);
                return distance;
            }
            limit
        });
        best
    }

    #[test]
    fn agrees_with_trying_all() {
        let points = random_points(300);
        let tree = NearestTree::new(points.clone());
        for to in random_points(350).split_off(300) {
            let all = (0..300).filter(|number| number % 3 > 0);
            let distance = |number: u32| squared_distance(&to, &points[number as usize]);
            let expected = all.min_by(|&a, &b| distance(a).total_cmp(&distance(b)));
            assert_eq!(nearest(&tree, &to, f64::INFINITY, |number| number % 3 > 0), expected);
        }
    }

    #[test]
    fn nothing_is_near_enough_or_there() {
        let tree = NearestTree::new(random_points(9));
        assert_eq!(nearest(&tree, &[5.0; 9], 1.0, |_| true), None);
        assert_eq!(nearest(&tree, &[0.5; 9], f64::INFINITY, |_| false), None);
        assert_eq!(nearest(&NearestTree::new(Vec::new()), &[0.0; 9], 1.0, |_| true), None);
    }
}
