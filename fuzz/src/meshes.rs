//! Meshes and options from arbitrary bytes: mostly sound ones of odd shapes, and now and then one
//! that breaks a rule.

use arbitrary::Arbitrary;
use chamfer::{
    ChamferSubmesh, MeshBuffers, Options, UV_CHANNELS, UvBuffer, Verify, Width, split_by_angle,
};

use crate::noise::Noise;
use crate::shapes::{Net, Shape};

/// A mesh in the making.
#[derive(Arbitrary, Debug)]
pub struct Spec {
    shape: Shape,
    size: Size,
    shading: Shading,
    streams: Streams,
    /// A second one of the same, so many units beside the first.
    copy: Option<[i8; 3]>,
    submeshes: u8,
    /// Done only where the number is large: a mesh that is refused teaches little.
    spoil: (u8, Spoil),
}

/// How large the mesh is, and where it stands.
#[derive(Arbitrary, Debug)]
enum Size {
    AsItIs,
    /// By a power of two, up to and past what single precision holds.
    Scaled(i8),
    /// Each axis by a power of its own: slivers.
    Stretched([i8; 3]),
    /// Far from the origin.
    Shifted([i32; 3]),
    /// By any number.
    Times(f32),
}

/// Where its normals come from.
#[derive(Arbitrary, Debug)]
enum Shading {
    Flat,
    ByAngle(u8),
    /// Noise of length one.
    Noise(u64),
    /// As they come: of any length, zero included.
    Given(Vec<[i8; 3]>),
}

/// Which streams it has besides, filled with noise.
#[derive(Arbitrary, Debug)]
struct Streams {
    tangents: bool,
    colors: bool,
    uvs: [u8; UV_CHANNELS],
    /// Texture coordinates are whole multiples of this, so that some agree across edges.
    coarse: bool,
    seed: u64,
}

/// A broken rule.
#[derive(Arbitrary, Debug)]
enum Spoil {
    /// The bits of a value in a stream.
    Value(u8, u16, u32),
    Index(u16, u32),
    Count(u8, u32),
    FewerNormals(u8),
    FewerUvs(u8),
    UvWidth(u8, u32),
}

/// Options of any value.
#[derive(Arbitrary, Debug)]
pub struct Wishes {
    width: WidthWish,
    /// In 250ths, or any bits.
    breadth: Result<u8, f32>,
    full: bool,
    submesh: Option<u8>,
    own: bool,
    threads: u8,
    segments: u8,
    profile: Option<Result<u8, f32>>,
    /// In 250ths, or any bits.
    evenness: Option<Result<u8, f32>>,
}

#[derive(Arbitrary, Debug)]
enum WidthWish {
    /// In fiftieths of a percent.
    Percent(u16),
    AnyPercent(f32),
    Units(f32),
}

impl Wishes {
    /// As the library takes them.
    pub fn options(&self) -> Options {
        Options::default()
            .with_width(match self.width {
                WidthWish::Percent(fiftieths) => {
                    Width::PercentOfExtent(f32::from(fiftieths % 2000) / 50.0)
                }
                WidthWish::AnyPercent(percent) => Width::PercentOfExtent(percent),
                WidthWish::Units(units) => Width::Units(units),
            })
            .with_least_breadth(self.breadth.map_or_else(|any| any, |part| f32::from(part) / 250.0))
            .with_verify(if self.full { Verify::Full } else { Verify::Fast })
            .with_chamfer_submesh(match (self.own, self.submesh) {
                (true, _) => ChamferSubmesh::Own,
                (false, None) => ChamferSubmesh::Owner,
                (false, Some(submesh)) => ChamferSubmesh::Given(u32::from(submesh % 4)),
            })
            .with_threads(u32::from(self.threads % 4))
            // Out of range now and then: nothing else takes as long as the most.
            .with_segments(u32::from(self.segments % 8))
            .with_profile(share(self.profile))
            .with_evenness(share(self.evenness))
    }
}

/// In 250ths, or any bits; a half where nothing is asked.
fn share(asked: Option<Result<u8, f32>>) -> f32 {
    asked.map_or(0.5, |share| match share {
        Ok(part) => f32::from(part) / 250.0,
        Err(any) => any,
    })
}

impl Spec {
    /// The mesh.
    pub fn mesh(&self) -> MeshBuffers {
        let mut mesh = self.clean_mesh();
        let (chance, spoil) = &self.spoil;
        if *chance > 0xF0 {
            spoil.apply(&mut mesh);
        }
        mesh
    }

    /// The mesh, which breaks no rule but those of its shape.
    pub fn clean_mesh(&self) -> MeshBuffers {
        let mut net = self.shape.net();
        self.add_copy(&mut net);
        net.points.iter_mut().for_each(|point| *point = self.size.apply(*point));
        let mut mesh = match is_finite(&net) {
            true => self.shading.shade(&net),
            // Smoothing asks for finite positions; what does not is refused by its own check.
            false => unshaded(&net),
        };
        self.streams.add_to(&mut mesh);
        mesh.submesh_index_counts = counts(mesh.indices.len() as u32, self.submeshes);
        mesh
    }

    fn add_copy(&self, net: &mut Net) {
        let Some(shift) = self.copy else { return };
        let count = net.points.len() as u32;
        let shifted =
            |point: &[f32; 3]| [0, 1, 2].map(|axis| point[axis] + f32::from(shift[axis] % 8));
        net.points.extend(net.points.iter().map(shifted).collect::<Vec<_>>());
        net.indices.extend(net.indices.iter().map(|index| index + count).collect::<Vec<_>>());
    }
}

fn is_finite(net: &Net) -> bool {
    net.points.as_flattened().iter().all(|along| along.is_finite())
}

fn unshaded(net: &Net) -> MeshBuffers {
    MeshBuffers {
        positions: net.points.clone(),
        normals: vec![[0.0, 1.0, 0.0]; net.points.len()],
        indices: net.indices.clone(),
        ..MeshBuffers::default()
    }
}

/// Cuts the triangles into a few submeshes, some of them empty.
fn counts(total: u32, submeshes: u8) -> Vec<u32> {
    let parts = 1 + u32::from(submeshes % 4);
    let share = total / 3 / parts * 3;
    let mut counts = vec![share; parts as usize - 1];
    counts.push(total - share * (parts - 1));
    if submeshes & 0x80 != 0 {
        counts.insert(0, 0);
    }
    counts
}

impl Size {
    fn apply(&self, point: [f32; 3]) -> [f32; 3] {
        let power = |exponent: i8| 2.0_f32.powi(i32::from(exponent));
        match *self {
            Size::AsItIs => point,
            // In two steps: 2^-140 alone is a number with few bits left.
            Size::Scaled(exponent) => point.map(|along| along * power(exponent) * 0.75),
            Size::Stretched(by) => [0, 1, 2].map(|axis| point[axis] * power(by[axis] / 12)),
            Size::Shifted(by) => [0, 1, 2].map(|axis| point[axis] + (by[axis] / 1000) as f32),
            Size::Times(factor) => point.map(|along| along * factor),
        }
    }
}

impl Shading {
    fn shade(&self, net: &Net) -> MeshBuffers {
        let degrees = match self {
            Shading::Flat => 1.0,
            Shading::ByAngle(degrees) => f32::from(degrees % 181),
            Shading::Noise(_) | Shading::Given(_) => 30.0,
        };
        let smoothed = split_by_angle(&net.points, &net.indices, degrees).unwrap_or_default();
        let mut mesh = MeshBuffers {
            positions: smoothed.source_of.iter().map(|&p| net.points[p as usize]).collect(),
            normals: smoothed.normals,
            indices: smoothed.indices,
            ..MeshBuffers::default()
        };
        match self {
            Shading::Flat | Shading::ByAngle(_) => {}
            Shading::Noise(seed) => {
                let mut noise = Noise::new(*seed);
                mesh.normals.iter_mut().for_each(|normal| *normal = unit(&mut noise));
            }
            Shading::Given(given) => {
                let given = given.iter().map(|normal| normal.map(|along| f32::from(along) / 64.0));
                mesh.normals.iter_mut().zip(given).for_each(|(normal, given)| *normal = given);
            }
        }
        mesh
    }
}

fn unit(noise: &mut Noise) -> [f32; 3] {
    let vector = [(); 3].map(|()| noise.signed());
    let length = vector.iter().map(|along| along * along).sum::<f32>().sqrt();
    if length > 0.01 { vector.map(|along| along / length) } else { [0.0, 0.0, 1.0] }
}

impl Streams {
    fn add_to(&self, mesh: &mut MeshBuffers) {
        let mut noise = Noise::new(self.seed);
        let count = mesh.positions.len();
        if self.tangents {
            mesh.tangents = mesh.normals.iter().map(|&normal| tangent(normal)).collect();
        }
        if self.colors {
            mesh.colors = (0..count).map(|_| [(); 4].map(|()| noise.signed().abs())).collect();
        }
        for (channel, &width) in self.uvs.iter().enumerate() {
            let components = match width % 8 {
                width @ 2..=4 => u32::from(width),
                _ => continue,
            };
            let mut value = || match self.coarse {
                true => (noise.signed() * 2.0).round(),
                false => noise.signed(),
            };
            let values = (0..count * components as usize).map(|_| value()).collect();
            mesh.uvs[channel] = UvBuffer { components, values };
        }
    }
}

/// Orthogonal to the normal, if that has a length.
fn tangent([x, y, z]: [f32; 3]) -> [f32; 4] {
    let [a, b, c] = if x.abs() > y.abs() { [-z, 0.0, x] } else { [0.0, z, -y] };
    let length = (a * a + b * b + c * c).sqrt();
    if length > 0.0 { [a / length, b / length, c / length, -1.0] } else { [1.0, 0.0, 0.0, 1.0] }
}

impl Spoil {
    fn apply(&self, mesh: &mut MeshBuffers) {
        match *self {
            Spoil::Value(stream, place, bits) => {
                let values = match stream % 5 {
                    0 => mesh.positions.as_flattened_mut(),
                    1 => mesh.normals.as_flattened_mut(),
                    2 => mesh.tangents.as_flattened_mut(),
                    3 => mesh.colors.as_flattened_mut(),
                    _ => &mut mesh.uvs[usize::from(stream) % UV_CHANNELS].values,
                };
                set(values, place, f32::from_bits(bits));
            }
            Spoil::Index(place, index) => set(&mut mesh.indices, place, index),
            Spoil::Count(place, count) => {
                set(&mut mesh.submesh_index_counts, u16::from(place), count);
            }
            Spoil::FewerNormals(count) => mesh.normals.truncate(count.into()),
            Spoil::FewerUvs(channel) => {
                mesh.uvs[usize::from(channel) % UV_CHANNELS].values.pop();
            }
            Spoil::UvWidth(channel, components) => {
                mesh.uvs[usize::from(channel) % UV_CHANNELS].components = components;
            }
        }
    }
}

fn set<T>(values: &mut [T], place: u16, value: T) {
    if !values.is_empty() {
        let place = usize::from(place) % values.len();
        values[place] = value;
    }
}
