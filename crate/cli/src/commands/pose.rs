//! `raconteur pose`.

use std::io::{self, Write as _};
use std::path::PathBuf;

use anyhow::{Result, bail};
use clap::Args;
use raconteur_stage::Shot;
use serde::Serialize;

use crate::report;
use crate::story::StoryFiles;
use crate::{Format, Outcome, terminal};

/// Print joint positions at given times.
#[derive(Args)]
pub(crate) struct Pose {
    /// Script, or folder that contains a story.eml.
    file: PathBuf,
    /// Times in seconds, separated by commas.
    #[arg(long, value_delimiter = ',', required = true)]
    at: Vec<f64>,
    /// A figure's name, or the path of a .glb file; without it, the story's choice, else sofia.
    #[arg(long)]
    figure: Option<String>,
    /// Print only a digest of every joint and morph for each time.
    #[arg(long)]
    digest: bool,
    /// Output format.
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

#[derive(Serialize)]
struct JointEntry {
    name: String,
    /// Metres.
    position_in_world: [f64; 3],
    /// Quaternion x, y, z, w.
    rotation: [f64; 4],
}

#[derive(Serialize)]
struct ManipulatorEntry {
    name: &'static str,
    /// The target of the wrist, metres.
    target_in_world: [f64; 3],
    /// Distance of the wrist from it, metres.
    error_m: f64,
}

#[derive(Serialize)]
struct Entry {
    time: f64,
    digest: String,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    joints: Vec<JointEntry>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    manipulators: Vec<ManipulatorEntry>,
}

impl Pose {
    pub(crate) fn run(&self) -> Result<Outcome> {
        let mut out = terminal::out();
        if let Some(bad) = self.at.iter().find(|t| !t.is_finite() || **t < 0.0) {
            bail!("--at needs times of 0 s or later, not {bad}");
        }
        let files = StoryFiles::read(&self.file)?;
        let mut loaded = files.player(self.figure.as_deref(), Shot::Storyteller)?;
        report::print(
            &files.script.display().to_string(),
            &files.text,
            &loaded.diagnostics,
        )?;
        let player = &mut loaded.player;
        let names: Vec<String> = player
            .figure()
            .skeleton
            .joints()
            .iter()
            .map(|j| j.name.clone())
            .collect();
        let mut entries = Vec::new();
        for &time in &self.at {
            let digest = format!("{:016x}", player.digest(time));
            let mut entry = Entry {
                time,
                digest,
                joints: Vec::new(),
                manipulators: Vec::new(),
            };
            if !self.digest {
                let frame = player.frame(time, 16.0 / 9.0);
                for (name, world) in names.iter().zip(&frame.world_from_joint) {
                    let (_, rotation, translation) = world.to_scale_rotation_translation();
                    entry.joints.push(JointEntry {
                        name: name.clone(),
                        position_in_world: translation.to_array(),
                        rotation: rotation.to_array(),
                    });
                }
                entry.manipulators = player
                    .hand_targets(time)
                    .into_iter()
                    .map(|m| ManipulatorEntry {
                        name: m.name,
                        target_in_world: m.target_in_world.to_array(),
                        error_m: m.error_m,
                    })
                    .collect();
            }
            entries.push(entry);
        }
        match self.format {
            Format::Json => writeln!(out, "{}", terminal::json_lines(&entries)?)?,
            Format::Text => {
                for entry in &entries {
                    print_entry(&mut out, entry)?;
                }
            }
        }
        Ok(report::outcome(&loaded.diagnostics))
    }
}

fn print_entry(out: &mut impl io::Write, entry: &Entry) -> io::Result<()> {
    writeln!(out, "at {:.3} s  digest {}", entry.time, entry.digest)?;
    for j in &entry.joints {
        let [x, y, z] = j.position_in_world;
        let [qx, qy, qz, qw] = j.rotation;
        writeln!(
            out,
            "  {:<28} {x:8.4} {y:8.4} {z:8.4}   {qx:7.4} {qy:7.4} {qz:7.4} {qw:7.4}",
            j.name
        )?;
    }
    for m in &entry.manipulators {
        let [x, y, z] = m.target_in_world;
        writeln!(
            out,
            "  {:<28} {x:8.4} {y:8.4} {z:8.4}   error {:.2} mm",
            m.name,
            m.error_m * 1e3
        )?;
    }
    Ok(())
}
