//! The names of materials.

use serde_json::Value;

use super::geometry::MeshGeometry;
use super::json;

/// `#meshes by #submeshes`: the name of the material of each, where it has one with a name.
pub fn names(json: &Value, geometries: &[MeshGeometry]) -> Vec<Vec<Option<String>>> {
    let of_mesh = |(mesh, geometry): (&Value, &MeshGeometry)| {
        let primitives = json::list(mesh, "primitives");
        let submeshes = geometry.submeshes.iter();
        submeshes.map(|submesh| name(json, primitives.get(submesh.primitive)?)).collect()
    };
    json::list(json, "meshes").iter().zip(geometries).map(of_mesh).collect()
}

fn name(json: &Value, primitive: &Value) -> Option<String> {
    let material = json::integer(primitive.get("material")?)?;
    let name = json::list(json, "materials").get(material)?.get("name")?;
    name.as_str().map(str::to_owned)
}
