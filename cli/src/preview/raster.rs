//! What each sample of a tile sees: the nearest triangle or line, by edge functions and a
//! depth buffer.

use super::camera::Projected;

/// Seen where there is nothing.
pub(super) const NOTHING: u32 = u32::MAX;

/// The nearest item at each sample of a square tile.
pub(super) struct Visibility {
    /// Samples per side.
    pub size: usize,
    /// `#samples`, row by row: the item's number, or [`NOTHING`].
    pub items: Vec<u32>,
    /// `#samples`: 1 / depth of the item, 0 where there is nothing.
    inverse_depths: Vec<f32>,
}

impl Visibility {
    pub fn new(size: usize) -> Self {
        Visibility {
            size,
            items: vec![NOTHING; size * size],
            inverse_depths: vec![0.0; size * size],
        }
    }

    /// Draws a triangle. Of two at the same depth the first stays.
    pub fn draw(&mut self, triangle: &ScreenTriangle, item: u32) {
        let (columns, rows) = triangle.bounds(self.size);
        for row in rows {
            for column in columns.clone() {
                let (x, y) = sample_center(column, row);
                let weights = triangle.edge_functions(x, y);
                if weights.iter().all(|&weight| weight >= 0.0) {
                    self.offer(column, row, triangle.inverse_depth(&weights), 0.0, item);
                }
            }
        }
    }

    /// Shows an item at a sample unless something nearer, by more than `bias`, is there already.
    pub fn offer(&mut self, column: usize, row: usize, depth: f64, bias: f64, item: u32) {
        let sample = row * self.size + column;
        if (depth + bias) as f32 > self.inverse_depths[sample] {
            self.inverse_depths[sample] = self.inverse_depths[sample].max(depth as f32);
            self.items[sample] = item;
        }
    }
}

/// Samples are looked up at their middle.
pub(super) fn sample_center(column: usize, row: usize) -> (f64, f64) {
    (column as f64 + 0.5, row as f64 + 0.5)
}

/// The samples, of `size`, whose middles lie between two coordinates.
pub(super) fn samples_between(low: f64, high: f64, size: usize) -> std::ops::Range<usize> {
    // Casts saturate: what lies outside the tile, however far, is cut off.
    let start = (low - 0.5).ceil().max(0.0) as usize;
    let end = ((high - 0.5).floor() + 1.0).max(0.0) as usize;
    start.min(size)..end.min(size)
}

/// A triangle as a tile sees it, ready for finding what covers a sample.
pub(super) struct ScreenTriangle {
    corners: [Projected; 3],
    /// `[a, b, c]` of each edge function `a x + b y + c`: edge i is opposite to corner i, and its
    /// function is twice the area of the triangle that a point makes with it.
    edges: [[f64; 3]; 3],
    /// Whether the corners go clockwise: the triangle's back is seen.
    pub is_back: bool,
}

impl ScreenTriangle {
    /// `None` where the triangle is seen as a line or a point.
    pub fn new(corners: [Projected; 3]) -> Option<Self> {
        let [a, b, c] = corners;
        let mut edges = [edge(b, c), edge(c, a), edge(a, b)];
        let [u, v, w] = edges[0];
        let area = u * a.x + v * a.y + w;
        if !(area.is_finite() && area != 0.0) {
            return None;
        }
        if area < 0.0 {
            edges = edges.map(|edge| edge.map(|value| -value));
        }
        // y points down, so a counter-clockwise triangle has a negative area.
        Some(ScreenTriangle { corners, edges, is_back: area > 0.0 })
    }

    /// The weights of the three corners at a point of the triangle, in perspective; their sum is 1.
    pub fn weights(&self, x: f64, y: f64) -> [f32; 3] {
        let functions = self.edge_functions(x, y);
        let scaled: [f64; 3] =
            std::array::from_fn(|i| functions[i] * self.corners[i].inverse_depth);
        let total = scaled[0] + scaled[1] + scaled[2];
        scaled.map(|weight| (weight / total) as f32)
    }

    /// All three positive inside. The common edge of two triangles gives both the same value but
    /// for the sign, bit for bit, so no sample falls between them.
    fn edge_functions(&self, x: f64, y: f64) -> [f64; 3] {
        self.edges.map(|[a, b, c]| a * x + (b * y + c))
    }

    fn inverse_depth(&self, weights: &[f64; 3]) -> f64 {
        let [p, q, r] = self.corners.map(|corner| corner.inverse_depth);
        let [u, v, w] = weights;
        (u * p + v * q + w * r) / (u + v + w)
    }

    /// The columns and rows that the triangle may cover.
    fn bounds(&self, size: usize) -> (std::ops::Range<usize>, std::ops::Range<usize>) {
        let range = |values: [f64; 3]| {
            let low = values.into_iter().fold(f64::INFINITY, f64::min);
            let high = values.into_iter().fold(f64::NEG_INFINITY, f64::max);
            samples_between(low, high, size)
        };
        (range(self.corners.map(|c| c.x)), range(self.corners.map(|c| c.y)))
    }
}

fn edge(from: Projected, to: Projected) -> [f64; 3] {
    [from.y - to.y, to.x - from.x, from.x * to.y - to.x * from.y]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangle(points: [[f64; 2]; 3], depth: f64) -> ScreenTriangle {
        ScreenTriangle::new(points.map(|[x, y]| Projected { x, y, inverse_depth: 1.0 / depth }))
            .unwrap()
    }

    //  0,0 ---- 4,0
    //   |  0  /  |
    //   |   /  1 |
    //  0,4 ---- 4,4
    fn halves() -> [ScreenTriangle; 2] {
        [
            triangle([[0.0, 0.0], [0.0, 4.0], [4.0, 0.0]], 2.0),
            triangle([[4.0, 0.0], [0.0, 4.0], [4.0, 4.0]], 2.0),
        ]
    }

    #[test]
    fn two_triangles_cover_a_square_without_a_gap() {
        let mut seen = Visibility::new(4);
        let [first, second] = halves();
        seen.draw(&first, 0);
        seen.draw(&second, 1);
        assert_eq!(seen.items, [0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 1, 1, 0, 1, 1, 1]);
    }

    #[test]
    fn the_nearer_triangle_wins_in_either_order() {
        let whole = [[-9.0, -9.0], [-9.0, 30.0], [30.0, -9.0]];
        let (near, far) = (triangle(whole, 1.0), triangle(whole, 2.0));
        for order in [[(&near, 7), (&far, 8)], [(&far, 8), (&near, 7)]] {
            let mut seen = Visibility::new(4);
            order.into_iter().for_each(|(triangle, item)| seen.draw(triangle, item));
            assert_eq!(seen.items, [7; 16]);
        }
    }

    #[test]
    fn a_clockwise_triangle_shows_its_back() {
        assert!(!halves()[0].is_back);
        assert!(triangle([[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]], 2.0).is_back);
    }

    #[test]
    fn a_triangle_without_area_is_none() {
        let corner = |x| Projected { x, y: x, inverse_depth: 1.0 };
        assert!(ScreenTriangle::new([corner(0.0), corner(1.0), corner(2.0)]).is_none());
        assert!(ScreenTriangle::new([corner(0.0), corner(f64::NAN), corner(2.0)]).is_none());
    }

    #[test]
    fn weights_are_those_of_the_corners_in_perspective() {
        let corners = [(0.0, 0.0, 1.0), (4.0, 0.0, 3.0), (0.0, 4.0, 1.0)];
        let corners = corners.map(|(x, y, depth)| Projected { x, y, inverse_depth: 1.0 / depth });
        let triangle = ScreenTriangle::new(corners).unwrap();
        assert_eq!(triangle.weights(0.0, 0.0), [1.0, 0.0, 0.0]);
        assert_eq!(triangle.weights(2.0, 0.0), [0.75, 0.25, 0.0]);
    }

    #[test]
    fn samples_outside_of_the_tile_are_cut_off() {
        assert_eq!(samples_between(-1e300, 1e300, 4), 0..4);
        assert_eq!(samples_between(0.6, 2.4, 4), 1..2);
        assert!(samples_between(0.6, 1.4, 4).is_empty());
        assert!(samples_between(f64::NAN, f64::NAN, 4).is_empty());
    }
}
