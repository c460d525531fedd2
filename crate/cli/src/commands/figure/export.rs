//! `raconteur figure export`.

use std::io::Write as _;
use std::path::PathBuf;

use anyhow::{Context as _, Result, bail};
use clap::{Args, ValueEnum};
use raconteur_base::DAffine3;
use raconteur_body::{Figure, write};
use raconteur_sculpt::bones;
use serde_json::{Value, json};

use super::{obj, params};
use crate::sheet::PoseName;
use crate::story::find_figure;
use crate::{Outcome, terminal};
use raconteur_voice::files::disk::replace;

/// Write a figure for other programs, as glTF binary or Wavefront OBJ.
#[derive(Args)]
pub(super) struct Export {
    /// A figure's name, or the path of a .glb file.
    figure: String,
    /// Output file; the name ends in .glb or .obj.
    #[arg(short, long)]
    output: PathBuf,
    /// Pose; a glTF file retains its skeleton, set to that pose.
    #[arg(long, value_enum, default_value = "bind")]
    pose: PoseName,
    /// The format; bones are known for the figures of the library, by their names.
    #[arg(long, value_enum, default_value = "skin")]
    layer: Layer,
}

/// Layers in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Layer {
    /// Skin.
    Skin,
    /// Skull, jaw, hands and the rest of the skeleton.
    Bones,
    /// Skin and bones.
    All,
}

impl Layer {
    fn build(self, name: &str) -> Result<Figure> {
        let layer = match self {
            Self::Skin => return find_figure(name),
            Self::Bones => bones::Layer::Bones,
            Self::All => bones::Layer::All,
        };
        let params = params::preset(name)?;
        Ok(bones::layered(
            &params,
            &raconteur_sculpt::build(&params),
            layer,
        ))
    }
}

impl Export {
    pub(super) fn run(&self) -> Result<Outcome> {
        let figure = self.layer.build(&self.figure)?;
        let extension = self.output.extension().and_then(|e| e.to_str());
        let bytes = match extension.map(str::to_ascii_lowercase).as_deref() {
            Some("glb") => posed_glb(&figure, self.pose)?,
            Some("obj") => obj::write(&figure, &self.pose.posed(&figure)).into_bytes(),
            _ => bail!(
                "{}: figures are exported as .glb or .obj",
                self.output.display()
            ),
        };
        replace(&self.output, &bytes)?;
        writeln!(
            terminal::out(),
            "{}: {} bytes",
            self.output.display(),
            bytes.len()
        )?;
        Ok(Outcome::Fine)
    }
}

/// Returns the figure as GLB with its joints placed in a pose; the bind pose of the skin is
/// unchanged.
fn posed_glb(figure: &Figure, pose: PoseName) -> Result<Vec<u8>> {
    let glb = write::to_glb(figure);
    if pose == PoseName::Bind {
        return Ok(glb);
    }
    let world = pose.posed(figure).world_from_joint;
    edit_json(&glb, |root| {
        for (joint, placed) in figure.skeleton.joints().iter().zip(&world) {
            let local = joint
                .parent
                .map_or(*placed, |parent| world[parent].inverse() * *placed);
            if let Some(node) = node_named(root, &joint.name) {
                place(node, &local);
            }
        }
    })
}

fn node_named<'a>(root: &'a mut Value, name: &str) -> Option<&'a mut Value> {
    root["nodes"]
        .as_array_mut()?
        .iter_mut()
        .find(|node| node["name"] == name)
}

fn place(node: &mut Value, local: &DAffine3) {
    let (_, rotation, translation) = local.to_scale_rotation_translation();
    let narrow = |values: &[f64]| values.iter().map(|&v| v as f32).collect::<Vec<_>>();
    node["rotation"] = json!(narrow(&rotation.normalize().to_array()));
    node["translation"] = json!(narrow(&translation.to_array()));
}

/// Edits the JSON chunk of a glTF binary, which is the first; the other chunks are unchanged.
fn edit_json(glb: &[u8], edit: impl FnOnce(&mut Value)) -> Result<Vec<u8>> {
    const HEAD: usize = 12;
    const CHUNK_HEAD: usize = 8;
    let length = glb
        .get(HEAD..HEAD + 4)
        .and_then(|b| b.try_into().ok())
        .map(u32::from_le_bytes)
        .context("the figure has no JSON chunk")? as usize;
    let begin = HEAD + CHUNK_HEAD;
    let json = glb
        .get(begin..begin + length)
        .context("the figure's JSON chunk is cut short")?;
    let mut root: Value = serde_json::from_slice(json)?;
    edit(&mut root);
    let mut text = serde_json::to_vec(&root)?;
    text.resize(text.len().next_multiple_of(4), b' ');
    let rest = &glb[begin + length..];
    let mut out = Vec::with_capacity(begin + text.len() + rest.len());
    out.extend(&glb[..8]);
    out.extend(u32::try_from(begin + text.len() + rest.len())?.to_le_bytes());
    out.extend(u32::try_from(text.len())?.to_le_bytes());
    out.extend(&glb[HEAD + 4..begin]);
    out.extend(text);
    out.extend(rest);
    Ok(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn editing_keeps_the_container_sound() {
        let mut glb = Vec::new();
        glb.extend(b"glTF");
        glb.extend(2_u32.to_le_bytes());
        glb.extend(44_u32.to_le_bytes());
        glb.extend(12_u32.to_le_bytes());
        glb.extend(b"JSON{\"a\": 1 }   "[..16].iter());
        glb.extend(4_u32.to_le_bytes());
        glb.extend(b"BIN\0wxyz");
        let out = edit_json(&glb, |root| root["b"] = json!("longer than before")).unwrap();
        let word = |at: usize| u32::from_le_bytes(out[at..at + 4].try_into().unwrap()) as usize;
        assert_eq!(word(8), out.len());
        assert_eq!(word(12) % 4, 0);
        let json: Value = serde_json::from_slice(&out[20..20 + word(12)]).unwrap();
        assert_eq!(json, json!({"a": 1, "b": "longer than before"}));
        assert!(out.ends_with(b"BIN\0wxyz"), "the binary chunk is unchanged");
    }
}
