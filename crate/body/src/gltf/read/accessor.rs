//! Checked access to the numbers of a glTF binary: no length, offset or index of the file is
//! trusted.

use std::borrow::Cow;

use super::ReadError;
use super::document::{Accessor, Component, Document, Sparse};

/// Maximum number of numbers read from a file: a figure has about two million, and views may be
/// referenced many times.
const MAX_NUMBERS: usize = 1 << 26;

/// glTF document with its binary chunk; reads accessors with every length, offset and index
/// checked.
pub struct Source<'a> {
    /// Parsed document.
    pub root: &'a Document<'a>,
    numbers_left: usize,
}

/// Memory layout of an accessor's elements.
struct Layout<'a> {
    bytes: Cow<'a, [u8]>,
    stride: usize,
    count: usize,
    component: Component,
    normalized: bool,
}

fn size(x: u64, what: &'static str) -> Result<usize, ReadError> {
    usize::try_from(x).map_err(|_| ReadError::Truncated { what })
}

/// Returns one component as a number. `b` holds at least its bytes.
fn component(b: &[u8], c: Component, normalized: bool) -> f32 {
    let (value, scale) = match c {
        Component::I8 => (f32::from(b[0] as i8), 127.0),
        Component::U8 => (f32::from(b[0]), 255.0),
        Component::I16 => (f32::from(i16::from_le_bytes([b[0], b[1]])), 32767.0),
        Component::U16 => (f32::from(u16::from_le_bytes([b[0], b[1]])), 65535.0),
        Component::U32 => (u32::from_le_bytes([b[0], b[1], b[2], b[3]]) as f32, 1.0),
        Component::F32 => (f32::from_le_bytes([b[0], b[1], b[2], b[3]]), 1.0),
    };
    if normalized {
        (value / scale).max(-1.0)
    } else {
        value
    }
}

/// Returns one unsigned component as an integer; the caller rejects signed and floating-point
/// types.
fn whole(b: &[u8], c: Component) -> u32 {
    match c {
        Component::U16 => u32::from(u16::from_le_bytes([b[0], b[1]])),
        Component::U32 => u32::from_le_bytes([b[0], b[1], b[2], b[3]]),
        _ => u32::from(b[0]),
    }
}

impl<'a> Source<'a> {
    /// Reads at most as many numbers as a figure needs.
    pub fn new(root: &'a Document<'a>) -> Self {
        Self {
            root,
            numbers_left: MAX_NUMBERS,
        }
    }

    fn spend(&mut self, count: usize) -> Result<(), ReadError> {
        self.numbers_left = self
            .numbers_left
            .checked_sub(count)
            .ok_or(ReadError::TooLarge)?;
        Ok(())
    }

    /// Returns the bytes of a view from an offset on, and its stride. Unpacked data count as
    /// numbers, each time.
    fn view(
        &mut self,
        index: usize,
        offset: usize,
        what: &'static str,
    ) -> Result<(Cow<'a, [u8]>, Option<usize>), ReadError> {
        let root = self.root;
        let view = root
            .views
            .get(index)
            .ok_or(ReadError::OutOfRange { what })?;
        let length = size(view.byte_length, what)?;
        let truncated = ReadError::Truncated { what };
        if let Some(packed) = &view.packed {
            self.spend(length)?;
            let mut bytes = packed.unpack(root.bin, length, view.byte_stride, what)?;
            if offset > bytes.len() {
                return Err(truncated);
            }
            bytes.drain(..offset);
            return Ok((bytes.into(), view.byte_stride));
        }
        if view.buffer != 0 {
            return Err(ReadError::OutOfRange { what });
        }
        let start = size(view.byte_offset, what)?;
        let bytes = start
            .checked_add(length)
            .and_then(|end| root.bin.get(start..end))
            .and_then(|b| b.get(offset..));
        Ok((bytes.ok_or(truncated)?.into(), view.byte_stride))
    }

    /// Returns all bytes of a buffer view. They count towards the limit of numbers, since several
    /// accessors may share a view.
    pub fn view_bytes(
        &mut self,
        index: usize,
        what: &'static str,
    ) -> Result<Cow<'a, [u8]>, ReadError> {
        let (bytes, _) = self.view(index, 0, what)?;
        self.spend(bytes.len())?;
        Ok(bytes)
    }

    fn accessor(&self, index: usize, what: &'static str) -> Result<&'a Accessor, ReadError> {
        self.root
            .accessors
            .get(index)
            .ok_or(ReadError::OutOfRange { what })
    }

    fn shape(
        accessor: &Accessor,
        width: usize,
        what: &'static str,
    ) -> Result<Component, ReadError> {
        accessor
            .component
            .filter(|_| accessor.width == width)
            .ok_or(ReadError::Type { what })
    }

    fn layout(
        &mut self,
        index: usize,
        width: usize,
        what: &'static str,
    ) -> Result<Layout<'a>, ReadError> {
        let accessor = self.accessor(index, what)?;
        let component = Self::shape(accessor, width, what)?;
        let view = accessor.buffer_view.ok_or(ReadError::Type { what })?;
        let offset = size(accessor.byte_offset, what)?;
        let (bytes, stride) = self.view(view, offset, what)?;
        let element = width * component.bytes();
        let stride = stride.unwrap_or(element);
        let count = size(accessor.count, what)?;
        let needed = count.checked_sub(1).map_or(Some(0), |n| {
            n.checked_mul(stride).and_then(|x| x.checked_add(element))
        });
        if stride < element || needed.is_none_or(|n| n > bytes.len()) {
            return Err(ReadError::Truncated { what });
        }
        Ok(Layout {
            bytes,
            stride,
            count,
            component,
            normalized: accessor.normalized,
        })
    }

    /// Returns an accessor as finite numbers; quantised values are scaled if the accessor is
    /// normalised.
    pub fn floats<const N: usize>(
        &mut self,
        index: usize,
        what: &'static str,
    ) -> Result<Vec<[f32; N]>, ReadError> {
        let l = self.layout(index, N, what)?;
        self.spend(l.count * N)?;
        read_floats(&l, what)
    }

    /// Returns an accessor as unsigned integers.
    pub fn integers<const N: usize>(
        &mut self,
        index: usize,
        what: &'static str,
    ) -> Result<Vec<[u32; N]>, ReadError> {
        let l = self.layout(index, N, what)?;
        self.spend(l.count * N)?;
        read_integers(&l, what)
    }

    /// Returns an accessor that must have `expected_count` elements.
    fn counted(
        &self,
        index: usize,
        expected_count: usize,
        what: &'static str,
    ) -> Result<&'a Accessor, ReadError> {
        let accessor = self.accessor(index, what)?;
        if accessor.count != expected_count as u64 {
            return Err(ReadError::Count { what });
        }
        Ok(accessor)
    }

    /// Returns the non-zero elements of a morph target, from a sparse or dense accessor.
    #[allow(clippy::type_complexity, reason = "two parallel columns, used once")]
    pub fn nonzero(
        &mut self,
        index: usize,
        expected_count: usize,
        what: &'static str,
    ) -> Result<(Vec<u32>, Vec<[f32; 3]>), ReadError> {
        let accessor = self.counted(index, expected_count, what)?;
        let Some(sparse) = &accessor.sparse else {
            let dense: Vec<[f32; 3]> = self.floats(index, what)?;
            return Ok((0u32..).zip(dense).filter(|(_, v)| *v != [0.0; 3]).unzip());
        };
        if accessor.buffer_view.is_some() {
            return Err(ReadError::Type { what });
        }
        self.sparse_elements(accessor, sparse, expected_count, what)
    }

    /// Returns the elements that a sparse accessor replaces, indices ascending and in range.
    #[allow(clippy::type_complexity, reason = "two parallel columns")]
    fn sparse_elements<const N: usize>(
        &mut self,
        accessor: &Accessor,
        sparse: &Sparse,
        expected_count: usize,
        what: &'static str,
    ) -> Result<(Vec<u32>, Vec<[f32; N]>), ReadError> {
        let component = Self::shape(accessor, N, what)?;
        let count = size(sparse.count, what)?;
        self.spend(count.checked_mul(N + 1).ok_or(ReadError::TooLarge)?)?;
        let index_component = sparse.index_component.ok_or(ReadError::Type { what })?;
        let mut part = |view, offset: u64, component: Component, width| {
            let (bytes, _) = self.view(view, size(offset, what)?, what)?;
            let stride = width * component.bytes();
            if count.checked_mul(stride).is_none_or(|n| n > bytes.len()) {
                return Err(ReadError::Truncated { what });
            }
            Ok(Layout {
                bytes,
                stride,
                count,
                component,
                normalized: accessor.normalized,
            })
        };
        let places = part(sparse.index_view, sparse.index_offset, index_component, 1)?;
        let values = part(sparse.value_view, sparse.value_offset, component, N)?;
        let places: Vec<u32> = read_integers::<1>(&places, what)?
            .into_iter()
            .map(|[i]| i)
            .collect();
        let ascending = places.windows(2).all(|w| w[0] < w[1]);
        if !ascending || places.last().is_some_and(|&i| i as usize >= expected_count) {
            return Err(ReadError::OutOfRange { what });
        }
        Ok((places, read_floats(&values, what)?))
    }
}

/// Storage variants found in third-party files only.
impl<'a> Source<'a> {
    /// Creates a source that takes at most this many numbers from the document.
    pub fn with_budget(root: &'a Document<'a>, numbers: usize) -> Self {
        Self {
            root,
            numbers_left: numbers,
        }
    }

    /// Numbers an element of an accessor has, 0 for an unknown type.
    pub fn width(&self, index: usize, what: &'static str) -> Result<usize, ReadError> {
        Ok(self.accessor(index, what)?.width)
    }

    /// Returns the number of elements that an accessor declares, without allocating for it.
    pub fn claimed_count(&self, index: usize, what: &'static str) -> Result<u64, ReadError> {
        Ok(self.accessor(index, what)?.count)
    }

    /// Returns an accessor as finite numbers, stored dense, sparse over a view, or sparse over
    /// zeros.
    pub fn dense<const N: usize>(
        &mut self,
        index: usize,
        what: &'static str,
    ) -> Result<Vec<[f32; N]>, ReadError> {
        let accessor = self.accessor(index, what)?;
        Self::shape(accessor, N, what)?;
        let mut out = if accessor.buffer_view.is_some() {
            self.floats(index, what)?
        } else {
            let count = size(accessor.count, what)?;
            self.spend(count.checked_mul(N).ok_or(ReadError::TooLarge)?)?;
            vec![[0.0; N]; count]
        };
        if let Some(sparse) = &accessor.sparse {
            let (places, values) = self.sparse_elements(accessor, sparse, out.len(), what)?;
            for (place, value) in places.into_iter().zip(values) {
                out[place as usize] = value;
            }
        }
        Ok(out)
    }

    /// Returns the non-zero elements of a morph target, for any kind of storage.
    #[allow(clippy::type_complexity, reason = "two parallel columns")]
    pub fn moved(
        &mut self,
        index: usize,
        expected_count: usize,
        what: &'static str,
    ) -> Result<(Vec<u32>, Vec<[f32; 3]>), ReadError> {
        let accessor = self.counted(index, expected_count, what)?;
        if accessor.sparse.is_some() && accessor.buffer_view.is_none() {
            return self.nonzero(index, expected_count, what);
        }
        let dense: Vec<[f32; 3]> = self.dense(index, what)?;
        Ok((0u32..).zip(dense).filter(|(_, v)| *v != [0.0; 3]).unzip())
    }
}

fn read_floats<const N: usize>(
    l: &Layout<'_>,
    what: &'static str,
) -> Result<Vec<[f32; N]>, ReadError> {
    let width = l.component.bytes();
    (0..l.count)
        .map(|i| {
            let element: [f32; N] = core::array::from_fn(|k| {
                component(
                    &l.bytes[i * l.stride + k * width..],
                    l.component,
                    l.normalized,
                )
            });
            if element.iter().all(|x| x.is_finite()) {
                Ok(element)
            } else {
                Err(ReadError::NotFinite { what })
            }
        })
        .collect()
}

fn read_integers<const N: usize>(
    l: &Layout<'_>,
    what: &'static str,
) -> Result<Vec<[u32; N]>, ReadError> {
    if !matches!(l.component, Component::U8 | Component::U16 | Component::U32) {
        return Err(ReadError::Type { what });
    }
    let width = l.component.bytes();
    Ok((0..l.count)
        .map(|i| core::array::from_fn(|k| whole(&l.bytes[i * l.stride + k * width..], l.component)))
        .collect())
}
