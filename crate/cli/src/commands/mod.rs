//! Commands, one file each.

pub(crate) mod bake;
pub(crate) mod check;
pub(crate) mod compose;
pub(crate) mod export;
pub(crate) mod express;
pub(crate) mod faces;
pub(crate) mod figure;
pub(crate) mod fmt;
pub(crate) mod import;
pub(crate) mod motion;
pub(crate) mod new;
pub(crate) mod pose;
pub(crate) mod render;
pub(crate) mod serve;
pub(crate) mod story_check;
pub(crate) mod sweep;
pub(crate) mod timeline;
pub(crate) mod transcription;
pub(crate) mod voice;
