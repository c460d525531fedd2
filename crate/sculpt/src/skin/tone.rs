//! Tones: the colour of the skin at the vertices of the head, as textures of a face space.

use raconteur_base::ops;

use super::SkinParams;
use super::pigment::Palette;
use crate::atlas::Hit;
use crate::head::{HeadParams, HeadSheet, bare_sheet};
use crate::person::Person;

/// Computes the skin tone per vertex for a look. The tones are laid out on one head, the same for
/// all.
pub struct Tones {
    sheet: HeadSheet,
    palette: Palette,
    /// Vertex of the rendered skin for each of the sheet's vertices, if there is one.
    drawn: Vec<Option<u32>>,
    count: usize,
}

/// Sample points of a triangle, which is represented by their mean: the three corners moved halfway
/// in.
const PLACES: [[f32; 3]; 3] = [
    [0.667, 0.1665, 0.1665],
    [0.1665, 0.667, 0.1665],
    [0.1665, 0.1665, 0.667],
];
/// Minimum brightness, linear.
const DARKEST: f64 = 1e-3;

impl Tones {
    /// Prepares the layout of tones on the head of a person.
    #[must_use]
    pub fn new(person: &Person, head: &HeadParams) -> Self {
        let (sheet, used) = bare_sheet(person, head);
        let mut drawn = vec![None; sheet.uv.len()];
        for (vertex, chart) in (0..).zip(&used) {
            drawn[*chart] = Some(vertex);
        }
        Self {
            sheet,
            palette: Palette::new(),
            drawn,
            count: used.len(),
        }
    }

    /// Returns the natural logarithms of linear red, green and blue of each vertex, averaged over
    /// the skin around it, without detail finer than the mesh.
    #[must_use]
    pub fn evaluate(&self, skin: &SkinParams, brow_colour: [f64; 3]) -> Vec<f64> {
        let sheet = HeadSheet {
            brow_colour,
            ..self.sheet.clone()
        };
        let painter = sheet.painter(skin, None);
        let mut sums = vec![[0.0; 4]; self.count];
        for (number, triangle) in (0..).zip(&sheet.triangles) {
            for weights in PLACES {
                let hit = Hit {
                    triangle: number,
                    weights,
                    #[cfg(test)]
                    inside: true,
                };
                let rgb = painter.tissue(*triangle, &hit).rgb(&self.palette);
                for (corner, weight) in triangle.iter().zip(weights) {
                    let Some(vertex) = self.drawn[*corner as usize] else {
                        continue;
                    };
                    let sum = &mut sums[vertex as usize];
                    for (part, x) in sum.iter_mut().zip(rgb.into_iter().chain([1.0])) {
                        *part += f64::from(weight) * x;
                    }
                }
            }
        }
        sums.iter()
            .flat_map(|&[r, g, b, all]| {
                [r, g, b].map(|x| ops::ln((x / all.max(1e-9)).max(DARKEST)))
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::people::preset;

    #[test]
    fn more_melanin_is_darker_everywhere_and_every_vertex_has_a_tone() {
        let like = preset("sofia").expect("a figure");
        let tones = Tones::new(&like.person, &like.head);
        let [light, dark] = [0.1, 0.8].map(|melanin| {
            let skin = SkinParams {
                melanin,
                ..SkinParams::plain()
            };
            tones.evaluate(&skin, [0.1; 3])
        });
        assert!(
            light.iter().all(|x| x.is_finite() && *x < 0.0),
            "every vertex has a finite tone"
        );
        let mean = |of: &[f64]| of.iter().sum::<f64>() / of.len() as f64;
        assert!(
            mean(&light) - mean(&dark) > 0.5,
            "more melanin darkens the mean tone"
        );
        let darker = light.iter().zip(&dark).filter(|(l, d)| d <= l).count();
        assert!(
            darker * 100 > light.len() * 97,
            "{darker} of {}",
            light.len()
        );
    }
}
