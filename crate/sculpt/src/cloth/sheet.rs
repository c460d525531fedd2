//! Sheet of a garment: faces of the body's cage, refined once. It preserves the cage's keys, so
//! that seams and edges can be named.

use std::collections::BTreeMap;

use raconteur_base::DVec3;

use crate::torso::cage::{Key, Tag};
use crate::torso::{CM, Cage, Field, Regions, Shell};

/// Cloth of a garment under construction, cut from the body's cage (coarse control mesh that is
/// subdivided), whose positions stay addressable for seams and edges.
#[derive(Clone, Debug)]
pub struct Sheet {
    /// Cloth surface.
    pub shell: Shell,
    /// Ring of the cage from which each face comes.
    pub tags: Vec<Tag>,
    /// Light that reaches each point past seams, 0..1.
    pub shade: Vec<f64>,
    places: BTreeMap<Key, u32>,
}

impl Sheet {
    /// Extracts the wanted faces from the cage and refines them once.
    #[must_use]
    pub fn extract(cage: &Cage, wanted: impl Fn(Tag) -> bool) -> Self {
        let (part, renamed) = cage.shell.select_named(|f| wanted(cage.tags[f]));
        let places = cage
            .keys
            .iter()
            .zip(&renamed)
            .filter_map(|(key, v)| v.map(|v| (*key, v)))
            .collect();
        let tags = cage
            .tags
            .iter()
            .filter(|t| wanted(**t))
            .flat_map(|t| [*t; 4])
            .collect();
        let (shell, _) = part.subdivided(1);
        Self {
            shade: vec![1.0; shell.points.len()],
            shell,
            tags,
            places,
        }
    }

    /// Returns the position of a cage vertex on the cloth; `None` if the cloth does not reach it.
    #[must_use]
    pub fn point(&self, key: Key) -> Option<DVec3> {
        self.places
            .get(&key)
            .map(|&v| self.shell.points[v as usize])
    }

    /// Returns the points along neighbouring cage vertices, within the cloth, including those added
    /// by refinement.
    #[must_use]
    pub fn line(&self, keys: impl IntoIterator<Item = Key>) -> Vec<u32> {
        let (around, _) = self.shell.neighbours();
        let mut out: Vec<u32> = Vec::new();
        for v in keys
            .into_iter()
            .filter_map(|k| self.places.get(&k).copied())
        {
            if let Some(&last) = out.last() {
                let between = around[last as usize]
                    .iter()
                    .find(|n| around[v as usize].contains(n));
                out.extend(between);
            }
            out.push(v);
        }
        out
    }

    /// Moves the cloth to its distance from a form. If softened, the form bridges hollows as cloth
    /// does.
    pub fn settle(
        &mut self,
        form: &Field,
        regions: Regions,
        soften: impl Fn(DVec3) -> f64,
        ease: impl Fn(DVec3) -> f64,
    ) {
        for _ in 0..4 {
            for p in &mut self.shell.points {
                let (d, n) = form.value_and_normal(*p, regions, soften(*p));
                *p += n * (ease(*p) - d).clamp(-3.0 * CM, 3.0 * CM) * 0.9;
            }
            self.shell.relax(2);
        }
    }

    /// Keeps only the selected faces and removes all others.
    pub fn retain(&mut self, wanted: impl Fn(&Shell, usize) -> bool) {
        let kept: Vec<bool> = (0..self.shell.faces.len())
            .map(|f| wanted(&self.shell, f))
            .collect();
        let (shell, renamed) = self.shell.select_named(|f| kept[f]);
        let mut shade = vec![1.0; shell.points.len()];
        for (old, new) in renamed.iter().enumerate() {
            if let Some(new) = new {
                shade[*new as usize] = self.shade[old];
            }
        }
        let mut kept = kept.into_iter();
        self.tags.retain(|_| kept.next().unwrap_or(false));
        self.places = core::mem::take(&mut self.places)
            .into_iter()
            .filter_map(|(k, v)| renamed[v as usize].map(|v| (k, v)))
            .collect();
        self.shell = shell;
        self.shade = shade;
    }
}
