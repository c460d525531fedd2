//! State of the performance at one time.

use raconteur_base::{DAffine3, NodeState};

use crate::{Camera, Lighting, Line, Set, Visibility};

/// Manipulators that a figure has: arms, legs and head (GEVH 3.3).
const MANIPULATORS: usize = 5;

/// Complete audiovisual state of a performance at one time, as input of the renderer.
#[derive(Clone, Debug)]
pub struct Frame {
    /// Story time, seconds.
    pub time_secs: f64,
    /// World from joint, one for each joint of the figure's skeleton.
    pub world_from_joint: Vec<DAffine3>,
    /// Weight of each of the figure's morph targets, usually 0..1.
    pub morph_weights: Vec<f32>,
    /// State of each node of the figure's tissue, in the order that the bindings of its
    /// meshes count; those that are not there are at rest. Empty for figures without tissue.
    pub tissue: Vec<NodeState>,
    /// Camera from which the frame is rendered.
    pub camera: Camera,
    /// Lights of the frame.
    pub lighting: Lighting,
    /// Floor and backdrop of the stage.
    pub set: Set,
    /// Visible parts of the figure.
    pub visibility: Visibility,
    /// World from each manipulator's target frame; rendered when [`Visibility::manipulators`] is
    /// set.
    pub handles: Vec<DAffine3>,
    /// Lines and dots rendered over the body: muscles, springs.
    pub lines: Vec<Line>,
    /// Diameter of the pupils, millimetres.
    pub pupil_mm: f64,
    /// The utterance being spoken, if any.
    pub speech: Option<CurrentSpeech>,
}

impl Frame {
    /// Creates an empty frame with capacity for a figure with this many joints and morph targets.
    #[must_use]
    pub fn with_capacity(joints: usize, morphs: usize) -> Self {
        Self {
            time_secs: 0.0,
            world_from_joint: Vec::with_capacity(joints),
            morph_weights: vec![0.0; morphs],
            tissue: Vec::new(),
            camera: Camera::default(),
            lighting: Lighting::default(),
            set: Set::default(),
            visibility: Visibility::default(),
            handles: Vec::with_capacity(MANIPULATORS),
            lines: Vec::new(),
            pupil_mm: 4.0,
            speech: None,
        }
    }
}

/// Utterance whose audio plays in a frame, and the position in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurrentSpeech {
    /// Index of the utterance in the story's performance.
    pub utterance: usize,
    /// Seconds since its start.
    pub offset_secs: f64,
    /// Index of the word being spoken, if any.
    pub word: Option<usize>,
}
