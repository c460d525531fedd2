//! Names on the mesh: landmarks and segments of the face, and their representation in a file.
//!
//! The file stores them in the scene's extras: `landmarks` maps a name to `[mesh, vertex]`;
//! `segments` is a list, parents first, of `{ name, parent, mesh, runs }`, where `runs` contains
//! pairs of first vertex and count. Mesh numbers are those of the file's `meshes`.

use serde_json::{Map, Value, json};

use crate::gltf::read::ReadError;
use crate::gltf::read::document;

/// Named point on the surface of a figure, for example a corner of the mouth.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Landmark {
    /// Craniofacial name, for example `n` (nasion) or `ex_l` (left exocanthion).
    pub name: String,
    /// Index into the figure's meshes.
    pub mesh: usize,
    /// Vertex of that mesh.
    pub vertex: u32,
}

/// Named part of the face, as runs of vertices of one mesh.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Segment {
    /// Name, for example `alar wings`.
    pub name: String,
    /// Index of the segment it is a part of; always an earlier one.
    pub parent: Option<usize>,
    /// Index into the figure's meshes.
    pub mesh: usize,
    /// Its own vertices as (first, count), ascending; children's vertices are not included.
    pub runs: Vec<[u32; 2]>,
}

/// Landmarks and segments of a figure's meshes, stored in the scene's extras.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Annotations {
    /// Named points on the surface.
    pub landmarks: Vec<Landmark>,
    /// The tree of segments, parents before their children.
    pub segments: Vec<Segment>,
}

impl Annotations {
    /// Returns a landmark by name; `None` if there is none.
    #[must_use]
    pub fn landmark(&self, name: &str) -> Option<&Landmark> {
        self.landmarks.iter().find(|l| l.name == name)
    }

    /// Returns the JSON entries for a scene's extras.
    #[must_use]
    pub fn to_json(&self) -> Map<String, Value> {
        let landmarks: Map<String, Value> = self
            .landmarks
            .iter()
            .map(|l| (l.name.clone(), json!([l.mesh, l.vertex])))
            .collect();
        let segments: Vec<Value> = self
            .segments
            .iter()
            .map(|s| {
                let runs: Vec<u32> = s.runs.iter().flatten().copied().collect();
                json!({ "name": s.name, "parent": s.parent, "mesh": s.mesh, "runs": runs })
            })
            .collect();
        let mut all = Map::new();
        all.insert("landmarks".to_owned(), Value::Object(landmarks));
        all.insert("segments".to_owned(), Value::Array(segments));
        all
    }
}

/// Vertices of each mesh of a file: primitives of one mesh are counted together, which the
/// generator's files do not need.
fn vertex_counts(root: &Value) -> Vec<u64> {
    let list = |key: &str| root[key].as_array().map_or(&[][..], Vec::as_slice);
    let accessors = list("accessors");
    let count = |mesh: &Value| {
        let at = mesh["primitives"][0]["attributes"]["POSITION"].as_u64()?;
        accessors.get(usize::try_from(at).ok()?)?["count"].as_u64()
    };
    list("meshes")
        .iter()
        .map(|m| count(m).unwrap_or(0))
        .collect()
}

fn whole(value: &Value, what: &'static str) -> Result<u64, ReadError> {
    value.as_u64().ok_or(ReadError::Type { what })
}

/// Parses the index of a mesh; an error if there is no such mesh.
fn mesh_of(value: &Value, counts: &[u64], what: &'static str) -> Result<usize, ReadError> {
    let mesh = usize::try_from(whole(value, what)?).unwrap_or(usize::MAX);
    if mesh < counts.len() {
        Ok(mesh)
    } else {
        Err(ReadError::OutOfRange { what })
    }
}

/// Reads the annotations of a figure's meshes from a `.glb` file; a file without any gives empty
/// lists.
///
/// # Errors
/// Returns a [`ReadError`] if the file is not a valid GLB container, if an entry has a wrong type,
/// or if an entry names a mesh, vertex or parent that does not exist.
pub fn annotations(glb: &[u8]) -> Result<Annotations, ReadError> {
    const LANDMARK: &str = "a landmark";
    const SEGMENT: &str = "a segment";
    let (chunk, _) = document::chunks(glb)?;
    let root: Value =
        serde_json::from_slice(chunk).map_err(|e| ReadError::NotGlb(e.to_string()))?;
    let scene = root["scene"].as_u64().unwrap_or(0);
    let extras = usize::try_from(scene)
        .ok()
        .and_then(|i| root["scenes"].get(i))
        .map_or(&Value::Null, |s| &s["extras"]);
    let counts = vertex_counts(&root);
    let mut all = Annotations::default();
    if let Some(landmarks) = extras["landmarks"].as_object() {
        for (name, at) in landmarks {
            let mesh = mesh_of(&at[0], &counts, LANDMARK)?;
            let vertex = whole(&at[1], LANDMARK)?;
            if vertex >= counts[mesh] {
                return Err(ReadError::OutOfRange { what: LANDMARK });
            }
            all.landmarks.push(Landmark {
                name: name.clone(),
                mesh,
                vertex: vertex as u32,
            });
        }
    }
    let segments = extras["segments"].as_array().map_or(&[][..], Vec::as_slice);
    for (i, value) in segments.iter().enumerate() {
        let mesh = mesh_of(&value["mesh"], &counts, SEGMENT)?;
        let parent = match &value["parent"] {
            Value::Null => None,
            p => {
                let p = usize::try_from(whole(p, SEGMENT)?).unwrap_or(usize::MAX);
                if p >= i {
                    return Err(ReadError::OutOfRange { what: SEGMENT });
                }
                Some(p)
            }
        };
        let numbers = value["runs"].as_array().map_or(&[][..], Vec::as_slice);
        if !numbers.len().is_multiple_of(2) {
            return Err(ReadError::Truncated { what: SEGMENT });
        }
        let mut runs = Vec::with_capacity(numbers.len() / 2);
        let mut free = 0;
        for pair in numbers.chunks_exact(2) {
            let (first, count) = (whole(&pair[0], SEGMENT)?, whole(&pair[1], SEGMENT)?);
            let end = first.checked_add(count).filter(|&e| e <= counts[mesh]);
            let end = end.ok_or(ReadError::OutOfRange { what: SEGMENT })?;
            // Rising runs cannot claim more vertices than there are.
            if first < free {
                return Err(ReadError::OutOfRange { what: SEGMENT });
            }
            free = end;
            runs.push([first as u32, count as u32]);
        }
        all.segments.push(Segment {
            name: value["name"].as_str().unwrap_or_default().to_owned(),
            parent,
            mesh,
            runs,
        });
    }
    Ok(all)
}
