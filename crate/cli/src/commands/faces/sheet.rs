//! `raconteur faces sheet`.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result, ensure};
use clap::{Args, ValueEnum};
use indicatif::{ProgressBar, ProgressStyle};
use raconteur_body::MaterialKind;
use raconteur_faces::{Editor, Face, FaceModel, Part, Region};
use raconteur_render::RenderOptions;
use raconteur_render::headless::Headless;

use super::edits::Edits;
use super::{pack, put_on::PutOn};
use crate::Outcome;
use crate::picture::{self, write_png};
use crate::sheet::{self, ContactSheet, FaceView};
use crate::story::find_figure;

/// Contents of a sheet of faces.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum FaceChoice {
    /// The face that the edits make.
    Face,
    /// Random faces.
    Random,
    /// Faces of the database.
    Database,
    /// Each attribute of the face at −1, 0 and 1.
    Attributes,
    /// Each segment of a random face, put on the average face.
    Segments,
    /// The face at ages from 10 to 80.
    Ages,
    /// The face with more of each ancestry.
    Ancestry,
    /// First modes of shape, at two standard deviations in both directions.
    Modes,
}

/// Draw a sheet of faces.
#[derive(Args)]
pub(super) struct Sheet {
    /// A pack that `faces learn` wrote.
    pack: PathBuf,
    /// Output image (PNG).
    #[arg(short, long)]
    output: PathBuf,
    /// Contents of the sheet.
    #[arg(long, value_enum, default_value = "face")]
    show: FaceChoice,
    #[command(flatten)]
    edits: Edits,
    /// Number of faces, random or from the database.
    #[arg(long, default_value_t = 40)]
    count: usize,
    /// Number of the first of them.
    #[arg(long, default_value_t = 0)]
    first: usize,
    /// Show only this attribute.
    #[arg(long)]
    attribute: Option<String>,
    /// Views of each face.
    #[arg(long, value_enum, default_value = "front", value_delimiter = ',')]
    view: Vec<FaceView>,
    /// Figure that provides eyes, hair and clothes.
    #[arg(long, default_value = "kenji")]
    like: String,
    /// Leave the hair of the head away.
    #[arg(long)]
    bald: bool,
    /// Hair of the library, by name; `own`, `none` or `bald`. With several, each face is rendered
    /// with each.
    #[arg(
        long,
        value_name = "NAME",
        value_delimiter = ',',
        default_value = "own"
    )]
    hair: Vec<String>,
    /// Beards of the library, by name; `own` or `none`. With several, each face is rendered with
    /// each.
    #[arg(
        long,
        value_name = "NAME",
        value_delimiter = ',',
        default_value = "own"
    )]
    beard: Vec<String>,
    /// Height of a tile, pixels.
    #[arg(long, default_value_t = 256, value_parser = clap::value_parser!(u32).range(64..=1600))]
    size: u32,
    /// Number of tiles per row, edge to edge and without captions, for judges.
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=64))]
    grid: Option<u32>,
}

/// Hair values that are not donor names; the first changes nothing.
const NOT_LENT: [&str; 3] = ["own", "none", "bald"];
/// Tiles in a row with captions.
const COLUMNS: u32 = 8;
/// Ages of a row of ages, years.
const AGES: [f64; 8] = [10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0];

/// Face and its caption.
type Named = (String, Face);

impl Sheet {
    pub(super) fn run(&self) -> Result<Outcome> {
        let editor = Editor::new(pack::read(&self.pack)?)?;
        let faces = self.faces(&editor)?;
        ensure!(!faces.is_empty(), "there is nothing to show");
        let columns = match self.show {
            FaceChoice::Attributes | FaceChoice::Modes => 3 * self.view.len() as u32,
            _ => COLUMNS,
        };
        let drawing = SheetStyle {
            view: &self.view,
            like: &self.like,
            hair: &self.hair,
            beard: &self.beard,
            is_bald: self.bald,
            size: self.size,
            grid: self.grid,
            columns,
        };
        drawing.draw(&editor, &faces, &self.output)?;
        Ok(Outcome::Fine)
    }

    fn faces(&self, editor: &Editor) -> Result<Vec<Named>> {
        let numbers = self.first..self.first + self.count;
        let base = self.edits.face(editor)?;
        match self.show {
            FaceChoice::Face => Ok(vec![(String::new(), base)]),
            // The edits are of every face of a row: constraints over the database (F&H 5.1.7).
            FaceChoice::Random | FaceChoice::Database => numbers
                .map(|number| {
                    let mut face = if self.show == FaceChoice::Random {
                        editor.random(number as u64)
                    } else {
                        editor.example(number)?
                    };
                    self.edits.change(editor, &mut face)?;
                    Ok((number.to_string(), face))
                })
                .collect(),
            FaceChoice::Attributes => self.attributes(editor, &base),
            FaceChoice::Segments => segments(editor, &base, &editor.random(self.first as u64)),
            FaceChoice::Ages => ages(editor, &base),
            FaceChoice::Ancestry => ancestry(editor, &base),
            FaceChoice::Modes => Ok(modes(editor, self.count)),
        }
    }

    /// Returns the face with every attribute added at −1, 0 and 1, as a user would change it.
    fn attributes(&self, editor: &Editor, base: &Face) -> Result<Vec<Named>> {
        let mut out = Vec::new();
        for name in names(editor) {
            if self.attribute.as_ref().is_some_and(|only| *only != name) {
                continue;
            }
            for value in [-1.0, 0.0, 1.0] {
                let mut face = base.clone();
                add(editor, &mut face, &name, value)?;
                out.push((format!("{name} {value:+.0}"), face));
            }
        }
        Ok(out)
    }
}

/// Rendering options of a sheet of faces.
struct SheetStyle<'a> {
    view: &'a [FaceView],
    like: &'a str,
    hair: &'a [String],
    beard: &'a [String],
    is_bald: bool,
    size: u32,
    grid: Option<u32>,
    columns: u32,
}

impl SheetStyle<'_> {
    fn draw(&self, editor: &Editor, faces: &[Named], output: &Path) -> Result<()> {
        let mut figure = find_figure(self.like)?;
        if self.is_bald {
            figure
                .meshes
                .retain(|m| m.material.kind != MaterialKind::Hair);
        }
        let mut headless = Headless::new_blocking(RenderOptions::default()).context(
            "no graphics adapter (on Debian: apt install mesa-vulkan-drivers libvulkan1)",
        )?;
        picture::set_figure(&mut headless, &figure)?;
        let mut sent = figure.clone();
        let mut on = PutOn::new(figure, editor.model())?;
        let worn: Vec<[&str; 2]> = (self.hair.iter())
            .flat_map(|hair| self.beard.iter().map(move |beard| [hair, beard]))
            .map(|names| names.map(String::as_str))
            .collect();
        let lent: BTreeSet<&str> = worn.iter().flatten().copied().collect();
        for name in lent.into_iter().filter(|n| !NOT_LENT.contains(n)) {
            on.load_hair(editor.model(), name)?;
        }
        let bar = ProgressBar::new((faces.len() * worn.len()) as u64).with_style(
            ProgressStyle::with_template("{bar:30} {pos}/{len} faces, {eta} left")?,
        );
        let aspects = vec![1.0; faces.len() * worn.len() * self.view.len()];
        let mut board = ContactSheet::new(&aspects, self.size, self.grid, self.columns);
        for (name, face) in faces {
            for &worn in &worn {
                let figure = on.dressed(editor, face, worn)?;
                headless.set_shape(&sent, &figure, false)?;
                let lent = worn.iter().filter(|n| **n != NOT_LENT[0]);
                let words: Vec<&str> = std::iter::once(&name[..]).chain(lent.copied()).collect();
                for tile in sheet::faces(&figure, self.view, words.join(" ").trim()) {
                    board.put(&figure, &tile, &mut headless)?;
                }
                sent = figure;
                bar.inc(1);
            }
        }
        bar.finish_and_clear();
        let picture = board.picture();
        write_png(output, picture.size(), picture.rgba())
    }
}

/// Renders some faces of the database for raters, with their numbers, into a folder.
pub(super) fn for_raters(model: &FaceModel, indices: &[usize], folder: &Path) -> Result<()> {
    let editor = Editor::new(model.clone())?;
    let face = |index: &usize| Ok((index.to_string(), editor.example(*index)?));
    let faces: Vec<Named> = indices.iter().map(face).collect::<Result<_>>()?;
    let own = ["own".to_owned()];
    let drawing = SheetStyle {
        view: &[FaceView::Front, FaceView::ThreeQuarter],
        like: "kenji",
        hair: &own,
        beard: &own,
        is_bald: true,
        size: 320,
        grid: None,
        columns: 6,
    };
    drawing.draw(&editor, &faces, &folder.join("faces.png"))
}

/// Names of all attributes in the order of their groups.
pub(super) fn names(editor: &Editor) -> Vec<String> {
    let mut all: Vec<String> = Vec::new();
    for part in [Part::Shape, Part::Texture] {
        for named in editor.attributes(part) {
            if !all.contains(&named.attribute.name) {
                all.push(named.attribute.name.clone());
            }
        }
    }
    all
}

/// Adds so much of an attribute to both parts, where they have it.
fn add(editor: &Editor, face: &mut Face, name: &str, amount: f64) -> Result<()> {
    for part in [Part::Shape, Part::Texture] {
        let mut all = editor.attributes(part).iter();
        if all.any(|a| a.attribute.name == name) {
            let change = editor.attribute_change(part, name, &Region::whole_head())?;
            face.add(&change, amount);
        }
    }
    Ok(())
}

fn segments(editor: &Editor, base: &Face, from: &Face) -> Result<Vec<Named>> {
    let mut out = vec![
        ("before".to_owned(), base.clone()),
        ("from".to_owned(), from.clone()),
    ];
    for segment in editor.model().segments.all() {
        let mut face = base.clone();
        let region = editor.region(&[&segment.name], None)?;
        for part in [Part::Shape, Part::Texture] {
            editor.import(&mut face, from, part, &region);
        }
        out.push((segment.name.clone(), face));
    }
    Ok(out)
}

fn ages(editor: &Editor, base: &Face) -> Result<Vec<Named>> {
    let people = &editor.model().people;
    ensure!(!people.is_empty(), "the pack has no ages");
    let [years, sex] = ["age", "sex"].map(|name| editor.value(base, Part::Shape, name));
    let [years, sex] = [editor.years_of(years?), 0.5 + sex?];
    let one = |to: f64| {
        let mut face = base.clone();
        for part in [Part::Shape, Part::Texture] {
            let change = editor.change_of_years(part, [years, to], sex, &Region::whole_head())?;
            face.add(&change, 1.0);
        }
        Ok((format!("{to:.0} years"), face))
    };
    AGES.into_iter().map(one).collect()
}

fn ancestry(editor: &Editor, base: &Face) -> Result<Vec<Named>> {
    let mut out = Vec::new();
    for name in ["European", "Asian", "African"] {
        for amount in [-0.5, 0.5, 1.0] {
            let mut face = base.clone();
            add(editor, &mut face, name, amount)?;
            out.push((format!("{name} {amount:+}"), face));
        }
    }
    Ok(out)
}

fn modes(editor: &Editor, count: usize) -> Vec<Named> {
    let deviations = editor.model().shape.deviations();
    let modes = (0..count.min(deviations.len())).flat_map(|mode| {
        [-2.0, 0.0, 2.0].map(|way| {
            let mut own = vec![0.0; mode + 1];
            own[mode] = way * deviations[mode];
            (format!("mode {mode} {way:+.0}"), editor.face(&own, &[]))
        })
    });
    modes.collect()
}
