//! Contact sheets: one figure in many views, side by side.

mod caption;
mod emotion;
pub(crate) mod light;
mod picture;
mod pose;
mod posture;
mod tile;
mod view;
mod wire;

use anyhow::{Context as _, Result};
use clap::ValueEnum;
use raconteur_base::color::srgb_to_linear;
use raconteur_body::Figure;
use raconteur_render::headless::Headless;
use raconteur_stage::{Frame, Lighting, Set};

use picture::{Layout, Picture};
pub(crate) use pose::PoseName;
pub(crate) use posture::PosedFigure;
use tile::Style;
pub(crate) use tile::Tile;

/// Part of a contact sheet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum SheetPart {
    /// Everything.
    All,
    /// Front, three-quarter, profile.
    Face,
    /// The head from front, three-quarter, side and back; not part of all.
    Hair,
    /// Eyes from near, open and closed.
    Eyes,
    /// Front, side, back.
    Body,
    /// Palm and back of both hands; fist, point, pinch.
    Hands,
    /// The 61 hand shapes of the right hand, by number; not part of all.
    Shapes,
    /// Head turned, arm bent, arms raised.
    Poses,
    /// Teeth, jaw open, smile.
    Mouth,
    /// Each muscle of the face alone; not part of `all`.
    Muscles,
    /// The fifteen visemes; not part of all.
    Visemes,
    /// All emotion words, and fear at four intensities; not included in `all`.
    Emotions,
    /// One blink, frame by frame; not included in `all`.
    Blink,
    /// Head and shoulders, friendly; not part of all.
    Portrait,
    /// The face in every light.
    Lights,
    /// Edges of the triangles, without hair.
    Wireframe,
    /// White before black in the bind pose, to compare with other programs; not part of all.
    Silhouette,
}

/// Tiles that fit in a row.
const COLUMNS: u32 = 5;

/// Returns the tiles of the requested parts, in the order of [`SheetPart`].
pub(crate) fn tiles(figure: &Figure, parts: &[SheetPart], light: Lighting) -> Vec<Tile> {
    let wanted = |part: SheetPart| {
        parts.contains(&part)
            || (parts.contains(&SheetPart::All)
                && !matches!(
                    part,
                    SheetPart::Shapes
                        | SheetPart::Silhouette
                        | SheetPart::Muscles
                        | SheetPart::Visemes
                        | SheetPart::Emotions
                        | SheetPart::Blink
                        | SheetPart::Hair
                        | SheetPart::Portrait
                ))
    };
    SheetPart::value_variants()
        .iter()
        .filter(|&&part| part != SheetPart::All && wanted(part))
        .flat_map(|&part| tile::tiles(figure, part, light))
        .collect()
}

/// Renders tiles of one figure and lays them out, `grid` to a row without captions or gaps if
/// given; `drawn` is called after each.
pub(crate) fn draw(
    figure: &Figure,
    tiles: &[Tile],
    height: u32,
    grid: Option<u32>,
    headless: &mut Headless,
    drawn: impl Fn(),
) -> Result<Picture> {
    let aspects: Vec<f64> = tiles.iter().map(|t| t.aspect).collect();
    let mut board = ContactSheet::new(&aspects, height, grid, COLUMNS);
    for tile in tiles {
        board.put(figure, tile, headless)?;
        drawn();
    }
    Ok(board.picture())
}

/// Error message for too many tiles.
const FULL: &str = "more tiles than the sheet has places for";

/// Contact sheet under construction, to which tiles are added one after another.
pub(crate) struct ContactSheet {
    picture: Picture,
    layout: Layout,
    widths: Vec<u32>,
    height: u32,
    has_captions: bool,
    next: usize,
}

impl ContactSheet {
    /// Creates a sheet for tiles of these aspect ratios, `grid` to a row without captions or gaps
    /// if given, otherwise about `columns`.
    pub(crate) fn new(aspects: &[f64], height: u32, grid: Option<u32>, columns: u32) -> Self {
        let width = |aspect: &f64| ((f64::from(height) * aspect).round() as u32).max(1);
        let widths: Vec<u32> = aspects.iter().map(width).collect();
        let layout = match grid {
            Some(columns) => Layout::grid(&widths, height, columns),
            None => Layout::new(&widths, height, columns * height + 64),
        };
        Self {
            picture: Picture::new(&layout),
            layout,
            widths,
            height,
            has_captions: grid.is_none(),
            next: 0,
        }
    }

    /// Draws the next tile; the renderer has its figure.
    pub(crate) fn put(
        &mut self,
        figure: &Figure,
        tile: &Tile,
        headless: &mut Headless,
    ) -> Result<()> {
        let width = *self.widths.get(self.next).context(FULL)?;
        let mut frame =
            Frame::with_capacity(figure.skeleton.joints().len(), figure.morph_names.len());
        frame.set = light::room();
        frame
            .world_from_joint
            .clone_from(&tile.posed.world_from_joint);
        frame.morph_weights.clone_from(&tile.posed.morph_weights);
        frame.tissue.clone_from(&tile.posed.tissue);
        frame.camera = tile.camera;
        frame.lighting = tile.lighting;
        let size = (width, self.height);
        let pixels = match tile.style {
            Style::Lit => headless.render_rgba(&frame, width, self.height)?,
            Style::Wire => wire::draw(figure, &tile.posed, &tile.camera, size),
            Style::Silhouette => silhouette(headless, &mut frame, size)?,
        };
        self.place_tile(&pixels, &tile.caption)
    }

    /// Places the image of the next tile at its size.
    pub(crate) fn place_tile(&mut self, pixels: &[u8], caption: &str) -> Result<()> {
        let places = self
            .layout
            .places
            .get(self.next)
            .zip(self.widths.get(self.next));
        let (&place, &width) = places.context(FULL)?;
        self.next += 1;
        let size = (width, self.height);
        self.picture.place_tile(place, size, pixels);
        if self.has_captions {
            self.picture.write_under(place, size, caption);
        }
        Ok(())
    }

    /// Returns the finished image of the sheet.
    pub(crate) fn picture(self) -> Picture {
        self.picture
    }
}

/// View direction of a face on a contact sheet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum FaceView {
    /// View from the front.
    Front,
    /// Turned by 45°.
    ThreeQuarter,
    /// View from the side.
    Profile,
}

/// Tiles of a figure's face.
pub(crate) fn faces(figure: &Figure, views: &[FaceView], caption: &str) -> Vec<Tile> {
    tile::faces(figure, views, caption)
}

/// Two background intensities behind the figure, in the linear part of the display curve.
const BEHIND: [f32; 2] = [0.15, 0.35];

/// Computes a silhouette: the figure is where an image changes less than half as much as the
/// background.
fn silhouette(
    headless: &mut Headless,
    frame: &mut Frame,
    (width, height): (u32, u32),
) -> Result<Vec<u8>> {
    let mut before = |grey: f32| {
        frame.set = Set {
            backdrop_low: [grey; 3],
            backdrop_high: [grey; 3],
            ..light::room()
        };
        headless.render_rgba(frame, width, height)
    };
    let [dark, bright] = [before(BEHIND[0])?, before(BEHIND[1])?];
    frame.set = light::room();
    let pixels = dark.chunks_exact(4).zip(bright.chunks_exact(4));
    let light = |p: &[u8]| srgb_to_linear(f64::from(p[1]) / 255.0) as f32;
    let changes: Vec<f32> = pixels.map(|(d, b)| light(b) - light(d)).collect();
    let bare = changes.iter().copied().fold(0.0, f32::max);
    Ok(changes
        .into_iter()
        .flat_map(|change| {
            let grey = if change < 0.5 * bare { 255 } else { 0 };
            [grey, grey, grey, 255]
        })
        .collect())
}
