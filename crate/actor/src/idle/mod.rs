//! Unscripted motion: sway, breath, and eyes that turn to the gaze target.

pub mod gaze;
pub mod stance;
pub mod trunk;

/// Random streams: no two motions share their noise.
pub(crate) mod stream {
    pub(crate) const SPINE: u64 = 0x100;
    pub(crate) const HEAD: u64 = 0x110;
    pub(crate) const STANCE: u64 = 0x120;
    pub(crate) const SACCADE: u64 = 0x130;
    pub(crate) const GLANCE: u64 = 0x140;
    pub(crate) const BLINK: u64 = 0x150;
    pub(crate) const BREATH: u64 = 0x170;
    pub(crate) const FACE: u64 = 0x180;
    pub(crate) const ACCENT: u64 = 0x190;
    pub(crate) const RAISE: u64 = 0x1A0;
    pub(crate) const GAZE: u64 = 0x1B0;
    pub(crate) const THINK: u64 = 0x1C0;
    pub(crate) const LICK: u64 = 0x1D0;
    pub(crate) const LISTEN: u64 = 0x1E0;
    pub(crate) const STEP: u64 = 0x1F0;
    pub(crate) const SHIFT: u64 = 0x200;
    pub(crate) const ENGAGEMENT: u64 = 0x210;
    pub(crate) const NOD: u64 = 0x220;
    pub(crate) const POSTURE: u64 = 0x230;
    pub(crate) const REST: u64 = 0x240;
    pub(crate) const SECOND_HAND: u64 = 0x250;
    pub(crate) const BEAT: u64 = 0x260;
}
