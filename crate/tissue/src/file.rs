//! Tissue in a figure's file: one block of little-endian numbers, version first. Lengths and
//! indices are checked on reading, so that the network need not check them.

use super::tissue::{
    Arch, Attachment, Column, Fibre, FibreCurve, FibrePoint, Link, LipNode, Tissue,
};
use super::{MUSCLES, Muscle};

/// The block ends in zeros up to a multiple of this many bytes.
pub const PADDING: usize = 16;

/// Format version read by [`from_bytes`].
const VERSION: u16 = 1;
/// Maximum number of nodes, of fibre points and of other items in a file; the bundled figures have
/// some 4,000.
const MAX_NODES: usize = 30_000;
/// Quantisation step of depths, metres: 255 of them are 25 mm.
const DEPTH_STEP_M: f32 = 1e-4;

/// Error returned when tissue data in a file is rejected.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TissueError {
    /// Another version.
    #[error("the tissue is of version {0}; this program reads version {VERSION}")]
    Version(u16),
    /// The data ends early, or has trailing bytes.
    #[error("the tissue's length does not fit what it holds")]
    Length,
    /// A number is not finite, or an index is out of range.
    #[error("the tissue has a value that cannot be: {0}")]
    Value(&'static str),
}

/// Sequential reader of the encoded data.
struct Reader<'a>(&'a [u8]);

impl Reader<'_> {
    fn bytes<const N: usize>(&mut self) -> Result<[u8; N], TissueError> {
        let (head, rest) = self.0.split_first_chunk::<N>().ok_or(TissueError::Length)?;
        self.0 = rest;
        Ok(*head)
    }

    fn u8(&mut self) -> Result<u8, TissueError> {
        Ok(self.bytes::<1>()?[0])
    }

    fn u16(&mut self) -> Result<u16, TissueError> {
        Ok(u16::from_le_bytes(self.bytes()?))
    }

    fn f32(&mut self) -> Result<f32, TissueError> {
        let x = f32::from_le_bytes(self.bytes()?);
        // No point of a face is farther than this from the origin.
        if x.abs() < 100.0 {
            Ok(x)
        } else {
            Err(TissueError::Value("a number"))
        }
    }

    fn share(&mut self) -> Result<f32, TissueError> {
        Ok(f32::from(self.u8()?) / 255.0)
    }

    fn vector(&mut self) -> Result<[f32; 3], TissueError> {
        Ok([self.f32()?, self.f32()?, self.f32()?])
    }

    /// Reads a list that is preceded by its length.
    fn list<T>(
        &mut self,
        mut item: impl FnMut(&mut Self) -> Result<T, TissueError>,
    ) -> Result<Vec<T>, TissueError> {
        let count = usize::from(self.u16()?);
        // Each item has a byte at least.
        if count > MAX_NODES || count > self.0.len() {
            return Err(TissueError::Length);
        }
        (0..count).map(|_| item(self)).collect()
    }

    /// Reads an index that must be below `count`.
    fn index(&mut self, count: usize) -> Result<u16, TissueError> {
        let i = self.u16()?;
        if usize::from(i) < count {
            Ok(i)
        } else {
            Err(TissueError::Value("an index"))
        }
    }
}

fn fibre(r: &mut Reader<'_>) -> Result<Fibre, TissueError> {
    let at = usize::from(r.u8()?);
    let muscle = Muscle::all().nth(at).filter(|_| at < MUSCLES);
    let muscle = muscle.ok_or(TissueError::Value("a muscle"))?;
    let course = match r.u8()? {
        0 => FibreCurve::Linear,
        1 => FibreCurve::Towards(r.vector()?),
        kind @ (2 | 3) => FibreCurve::Oris {
            is_lower: kind == 3,
            out: r.share()?,
        },
        _ => return Err(TissueError::Value("a course")),
    };
    Ok(Fibre {
        muscle,
        course,
        first: r.u16()?,
        count: r.u8()?,
    })
}

fn arch(r: &mut Reader<'_>) -> Result<Arch, TissueError> {
    let (origin, step_m) = (r.vector()?, r.f32()?);
    let (rows, columns) = (r.u16()?, r.u16()?);
    let radii = r.list(|r| Ok(f32::from(r.u16()?) * 1e-6))?;
    let is_map = rows >= 2 && columns >= 2 && step_m > 1e-5;
    if radii.len() != usize::from(rows) * usize::from(columns) || !(is_map || radii.is_empty()) {
        return Err(TissueError::Length);
    }
    Ok(Arch {
        origin,
        step_m,
        rows,
        columns,
        radii,
    })
}

/// Reads the contacts of the skin with teeth and the other lip; the positions must already be read.
fn contact(r: &mut Reader<'_>, out: &mut Tissue) -> Result<(), TissueError> {
    let count = out.rest.len();
    let corner = |r: &mut Reader<'_>| r.index(count);
    out.columns = r.list(|r| {
        Ok(Column {
            contact: [corner(r)?, corner(r)?],
            edge: r.vector()?,
            bites: r.share()?,
        })
    })?;
    let columns = out.columns.len();
    out.lips = r.list(|r| {
        Ok(LipNode {
            node: corner(r)?,
            column: r.index(columns)?,
            closes: f32::from(r.u8()? as i8) / 127.0,
        })
    })?;
    out.pairs = r.list(|r| Ok([corner(r)?, corner(r)?]))?;
    out.before_teeth = r.list(corner)?;
    Ok(())
}

/// Reads a tissue (soft tissue of a face) from bytes.
///
/// # Errors
/// Returns an error if the version differs, the length is wrong, or a value is impossible.
pub fn from_bytes(bytes: &[u8]) -> Result<Tissue, TissueError> {
    let mut r = Reader(bytes);
    let version = r.u16()?;
    if version != VERSION {
        return Err(TissueError::Version(version));
    }
    let (scale, hinge) = (r.f32()?, r.vector()?);
    if !(0.1..10.0).contains(&scale) {
        return Err(TissueError::Value("the scale"));
    }
    let (low, size) = (r.vector()?, r.vector()?);
    let mut out = Tissue {
        scale,
        hinge,
        ..Tissue::default()
    };
    out.rest = r.list(|r| {
        let q = [r.u16()?, r.u16()?, r.u16()?];
        Ok([0, 1, 2].map(|k| low[k] + size[k] * f32::from(q[k]) / 65_535.0))
    })?;
    let count = out.rest.len();
    let mut holds = Vec::with_capacity(count);
    for _ in 0..count {
        out.jaw.push(r.share()?);
        out.depth.push(f32::from(r.u8()?) * DEPTH_STEP_M);
        out.grip.push(r.share()?);
        out.flush.push(r.share()?);
        holds.push(r.u8()?);
    }
    let corner = |r: &mut Reader<'_>| r.index(count);
    out.quads = r.list(|r| Ok([corner(r)?, corner(r)?, corner(r)?, corner(r)?]))?;
    out.points = r.list(|r| {
        Ok(FibrePoint {
            rest: r.vector()?,
            outwards: [r.u8()?, r.u8()?, r.u8()?].map(|b| f32::from(b as i8) / 127.0),
            jaw: r.share()?,
        })
    })?;
    let points = out.points.len();
    out.fibres = r.list(fibre)?;
    for f in &out.fibres {
        if f.count < 2 || usize::from(f.first) + usize::from(f.count) > points {
            return Err(TissueError::Value("a fibre"));
        }
    }
    out.starts.push(0);
    for held in holds {
        for _ in 0..held {
            out.attachments.push(Attachment {
                // A hold lies between its point and the next.
                point: r.index(points.saturating_sub(1))?,
                on: r.share()?,
                weight: r.share()?,
            });
        }
        out.starts.push(out.attachments.len() as u32);
    }
    out.links = r.list(|r| {
        Ok(Link {
            end: r.index(points)?,
            ring: r.index(points)?,
            weight: r.share()?,
        })
    })?;
    contact(&mut r, &mut out)?;
    out.arches = [arch(&mut r)?, arch(&mut r)?];
    if r.0.len() < PADDING && r.0.iter().all(|b| *b == 0) {
        Ok(out)
    } else {
        Err(TissueError::Length)
    }
}

/// Serialises a tissue for [`from_bytes`], with positions accurate to a thousandth of a millimetre
/// or two.
#[must_use]
pub fn to_bytes(tissue: &Tissue) -> Vec<u8> {
    let mut w = Writer(VERSION.to_le_bytes().to_vec());
    w.f32(tissue.scale);
    w.vector(tissue.hinge);
    let fold = |k: usize, f: fn(f32, f32) -> f32| tissue.rest.iter().map(|p| p[k]).reduce(f);
    let low = [0, 1, 2].map(|k| fold(k, f32::min).unwrap_or(0.0));
    let size = [0, 1, 2].map(|k| fold(k, f32::max).unwrap_or(0.0) - low[k]);
    w.vector(low);
    w.vector(size);
    w.list(&tissue.rest, |w, p| {
        for k in 0..3 {
            let share = (p[k] - low[k]) / size[k].max(1e-9);
            w.u16((share * 65_535.0).round() as u16);
        }
    });
    for i in 0..tissue.rest.len() {
        w.share(tissue.jaw[i]);
        w.u8((tissue.depth[i] / DEPTH_STEP_M).round() as u8);
        w.share(tissue.grip[i]);
        w.share(tissue.flush[i]);
        w.u8((tissue.starts[i + 1] - tissue.starts[i]) as u8);
    }
    w.list(&tissue.quads, |w, q| q.iter().for_each(|i| w.u16(*i)));
    w.list(&tissue.points, |w, p| {
        w.vector(p.rest);
        p.outwards.iter().for_each(|x| w.signed(*x));
        w.share(p.jaw);
    });
    w.list(&tissue.fibres, |w, f| {
        w.u8(f.muscle.index() as u8);
        match f.course {
            FibreCurve::Linear => w.u8(0),
            FibreCurve::Towards(centre) => {
                w.u8(1);
                w.vector(centre);
            }
            FibreCurve::Oris { is_lower, out } => {
                w.u8(2 + u8::from(is_lower));
                w.share(out);
            }
        }
        w.u16(f.first);
        w.u8(f.count);
    });
    for a in &tissue.attachments {
        w.u16(a.point);
        w.share(a.on);
        w.share(a.weight);
    }
    w.list(&tissue.links, |w, l| {
        w.u16(l.end);
        w.u16(l.ring);
        w.share(l.weight);
    });
    w.list(&tissue.columns, |w, c| {
        c.contact.iter().for_each(|i| w.u16(*i));
        w.vector(c.edge);
        w.share(c.bites);
    });
    w.list(&tissue.lips, |w, l| {
        w.u16(l.node);
        w.u16(l.column);
        w.signed(l.closes);
    });
    w.list(&tissue.pairs, |w, p| p.iter().for_each(|i| w.u16(*i)));
    w.list(&tissue.before_teeth, |w, i| w.u16(*i));
    for arch in &tissue.arches {
        w.vector(arch.origin);
        w.f32(arch.step_m);
        w.u16(arch.rows);
        w.u16(arch.columns);
        w.list(&arch.radii, |w, r| w.u16((r * 1e6).round() as u16));
    }
    w.0.resize(w.0.len().next_multiple_of(PADDING), 0);
    w.0
}

struct Writer(Vec<u8>);

impl Writer {
    fn u8(&mut self, x: u8) {
        self.0.push(x);
    }

    fn u16(&mut self, x: u16) {
        self.0.extend(x.to_le_bytes());
    }

    fn f32(&mut self, x: f32) {
        self.0.extend(x.to_le_bytes());
    }

    fn share(&mut self, x: f32) {
        self.u8((x * 255.0).round() as u8);
    }

    fn signed(&mut self, x: f32) {
        self.u8((x * 127.0).round() as i8 as u8);
    }

    fn vector(&mut self, v: [f32; 3]) {
        v.iter().for_each(|x| self.f32(*x));
    }

    fn list<T>(&mut self, items: &[T], mut item: impl FnMut(&mut Self, &T)) {
        self.u16(items.len() as u16);
        items.iter().for_each(|i| item(self, i));
    }
}
