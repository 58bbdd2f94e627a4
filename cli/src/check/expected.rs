//! What chamfering the file anew would give, to compare what came out with.

use anyhow::Result;
use chamfer::{Chamfered, MOST_SEGMENTS, MeshBuffers, Verify};
use chamfer_formats::Document;

use crate::args::CheckArgs;
use crate::chamfering::chamfer_document;
use crate::choices::Choices;
use crate::fit::Wish;

/// `#meshes`: what chamfering the file would give, where the width asked for is known.
pub fn expected(
    before: &dyn Document,
    after: &dyn Document,
    args: &CheckArgs,
    choices: Option<&Choices>,
) -> Result<Vec<Chamfered>> {
    let width = args.width().or(choices.map(Choices::length));
    let Some(width) = width else { return Ok(Vec::new()) };
    let wish = choices.map_or_else(Wish::default, |choices| choices.wish(1));
    let verify = if args.no_see_through { args.verify.into() } else { Verify::Seen };
    let per_mesh = args.per_mesh || wish.per_mesh;
    let hard_angle = args.hard_angle.unwrap_or(wish.core.hard_angle);
    let core = wish.core.with_verify(verify).with_hard_angle(hard_angle);
    let wish = Wish { core, width, per_mesh, ..wish };
    let made = |segments: u32| {
        let wish = Wish { core: wish.core.with_segments(segments), ..wish.clone() };
        Ok(chamfer_document(before, &wish, &|_| ())?.meshes)
    };
    match choices {
        Some(_) => made(wish.core.segments),
        None => nearest(triangles(after.meshes().iter().map(|mesh| &mesh.mesh)), made),
    }
}

/// What comes nearest to so many triangles, of what is made with one segment, with two, and so on: how
/// many there are has a say in where light would show, and so in which edges stay.
fn nearest(wanted: usize, made: impl Fn(u32) -> Result<Vec<Chamfered>>) -> Result<Vec<Chamfered>> {
    let off =
        |meshes: &[Chamfered]| triangles(meshes.iter().map(|result| &result.mesh)).abs_diff(wanted);
    let mut best = made(1)?;
    for segments in 2..=MOST_SEGMENTS {
        if triangles(best.iter().map(|result| &result.mesh)) >= wanted {
            break;
        }
        let next = made(segments)?;
        if off(&next) >= off(&best) {
            break;
        }
        best = next;
    }
    Ok(best)
}

fn triangles<'a>(meshes: impl Iterator<Item = &'a MeshBuffers>) -> usize {
    meshes.map(|mesh| mesh.indices.len() / 3).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use chamfer::{Options, Reason, Width, chamfer, shapes};
    use chamfer_formats::{ReadOptions, glb, read};
    use clap::Parser;
    use serde_json::{Value, json};

    use crate::preset;

    /// A file with a mesh in it.
    fn document(mesh: &MeshBuffers) -> Box<dyn Document> {
        placed(mesh, &json!([{ "mesh": 0 }]))
    }

    /// A file in which nodes have a mesh.
    fn placed(mesh: &MeshBuffers, nodes: &Value) -> Box<dyn Document> {
        let file = glb::encode("shape", mesh, &[], &[]).unwrap();
        let (head, rest) = file.split_at(20);
        let length = u32::from_le_bytes(head[12..16].try_into().unwrap()) as usize;
        let mut root: Value = serde_json::from_slice(&rest[..length]).unwrap();
        root["nodes"] = nodes.clone();
        root["scenes"][0]["nodes"] = (0..nodes.as_array().unwrap().len()).collect();
        let mut text = serde_json::to_vec(&root).unwrap();
        text.resize(text.len().next_multiple_of(4), b' ');
        let size = |bytes: usize| (bytes as u32).to_le_bytes();
        let all = 20 + text.len() + rest.len() - length;
        let head = [&head[..8], &size(all), &size(text.len()), &head[16..]].concat();
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("file.glb");
        std::fs::write(&path, [&head, &text[..], &rest[length..]].concat()).unwrap();
        read(&path, &ReadOptions::default()).unwrap()
    }

    #[derive(Parser)]
    struct Line {
        #[command(flatten)]
        check: CheckArgs,
    }

    /// What is expected of a file by a command line and a file of options, if there is one.
    fn asked(before: &dyn Document, line: &str, options: &str) -> Vec<Chamfered> {
        let words = ["check", "before", "after"].into_iter().chain(line.split_whitespace());
        let args = Line::parse_from(words).check;
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("options.toml");
        std::fs::write(&path, options).unwrap();
        let choices = (!options.is_empty()).then(|| preset::choices(&path).unwrap());
        expected(before, before, &args, choices.as_ref()).unwrap()
    }

    fn width(made: &[Chamfered]) -> f32 {
        made[0].largest_width
    }

    #[test]
    fn nothing_is_expected_where_no_width_is_known() {
        let cube = document(&shapes::cube(1.0));
        assert!(asked(&*cube, "", "").is_empty());
        assert_eq!(width(&asked(&*cube, "--width 0.04", "")), 0.04);
        assert_eq!(width(&asked(&*cube, "", "width = 4\n")), 0.04);
        let both = asked(&*cube, "--width 0.03", "width = 4\n");
        assert_eq!(width(&both), 0.03, "who writes a width means it");
    }

    #[test]
    fn a_width_is_that_of_the_scene_or_of_each_mesh_whoever_says_so() {
        let cube = placed(&shapes::cube(1.0), &json!([{ "mesh": 0, "scale": [2, 2, 2] }]));
        assert_eq!(width(&asked(&*cube, "--width 0.04", "")), 0.02);
        assert_eq!(width(&asked(&*cube, "--width 0.04 --per-mesh", "")), 0.04);
        let mesh = "width = \"0.04\"\nper_mesh = true\n";
        assert_eq!(width(&asked(&*cube, "", mesh)), 0.04);
    }

    #[test]
    fn options_tell_how_many_segments_and_which_edges() {
        let prism = document(&shapes::prism(6));
        let made = asked(&*prism, "", "width = 2\nsegments = 3\nmin_angle = 70\n");
        let chamfered = |made: &&chamfer::EdgeVerdict| made.reason != Reason::NotSelected;
        assert_eq!(made[0].verdicts.iter().filter(chamfered).count(), 12);
        assert_eq!(made[0].verdicts.iter().find(chamfered).unwrap().segments, 3);
        assert_eq!(segments(&asked(&*prism, "--width-percent 2", "")), 1, "as it came");
    }

    //  +---+
    //  | A |        the cubes touch along an edge: rounded there, they let light through
    //  +---+---+
    //      | B |
    //      +---+
    #[test]
    fn what_lets_light_through_is_expected_to_stay_where_somebody_looks() {
        let at = |x, y, z| json!({ "mesh": 0, "translation": [x, y, z] });
        let cubes = placed(&shapes::plain_cube(2.0), &json!([at(-1, 1, 0), at(1, -1, 1)]));
        let held = |line: &str| {
            let made = asked(&*cubes, line, "");
            made[0].verdicts.iter().any(|verdict| verdict.reason == Reason::Contact)
        };
        assert!(held("--width 0.05") && !held("--width 0.05 --no-see-through"));
    }

    fn made(segments: u32) -> Result<Vec<Chamfered>> {
        let options = Options::default().with_width(Width::Units(0.1)).with_segments(segments);
        Ok(vec![chamfer(&shapes::prism(6).as_mesh(), &options)?])
    }

    fn segments(meshes: &[Chamfered]) -> u32 {
        meshes[0].verdicts[0].segments
    }

    #[test]
    fn what_has_as_many_triangles_has_as_many_segments() {
        for wanted in 1..=4 {
            let result = made(wanted).unwrap();
            let count = triangles(result.iter().map(|made| &made.mesh));
            assert_eq!(segments(&result), wanted);
            assert_eq!(segments(&nearest(count, made).unwrap()), wanted);
            assert_eq!(
                segments(&nearest(count + 1, made).unwrap()),
                wanted,
                "a tool has added one"
            );
        }
    }

    #[test]
    fn between_two_counts_the_nearer_one_is_meant() {
        let count = |segments| triangles(made(segments).unwrap().iter().map(|made| &made.mesh));
        let (two, three) = (count(2), count(3));
        assert!(three > two + 4);
        assert_eq!(segments(&nearest(two + 1, made).unwrap()), 2);
        assert_eq!(segments(&nearest(three - 1, made).unwrap()), 3);
        let half = two + (three - two) / 2;
        assert_eq!((three - two) % 2, 0, "of two as near the one with fewer");
        assert_eq!(segments(&nearest(half, made).unwrap()), 2);
    }

    #[test]
    fn what_has_no_chamfers_is_taken_to_want_flat_ones() {
        let count = shapes::prism(6).indices.len() / 3;
        assert_eq!(segments(&nearest(count, made).unwrap()), 1);
    }
}
