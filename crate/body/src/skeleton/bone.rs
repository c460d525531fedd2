//! The 54 bones of GEVH appendix A and their frames.
//!
//! Frames of the zero pose (arms stretched out sideways, palms down): local x runs along the bone;
//! for spine and legs' chain, arms and fingers, local y and z complete a right-handed frame. The
//! source is left-handed (x left, y up, z back), and the z components of its rows for the right
//! hand must be negated. [`zero_frames`] does both once, by converting the left side and mirroring
//! it:
//!
//! | part | x | y | z | flexion |
//! |---|---|---|---|---|
//! | spine, neck, skull | up | front | left | +z bends forward |
//! | arm (both sides) | outwards along the arm | front | down (left), up (right) | elbow +z |
//! | fingers (both sides) | outwards along the finger | dorsal (up) | see below | −z bends to the palm |
//!
//! The right frame is the mirrored left frame with its z axis negated, which makes it a proper
//! rotation. A local rotation (x, y, z, w) on the left equals, mirrored on the sagittal plane, (−x,
//! −y, z, w) on the right: flexions about z keep their sign.

use raconteur_base::{DMat3, DQuat, DVec3, Length, Side, mirror_vector};

/// A bone of GEVH appendix A, in the order of its tree (A.2).
#[allow(
    missing_docs,
    reason = "the names are anatomical and listed in GEVH appendix A"
)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u8)]
pub enum Bone {
    Sacroiliac,
    RHip,
    RKnee,
    RSubtalar,
    RMidtarsal,
    RMetatarsal,
    LHip,
    LKnee,
    LSubtalar,
    LMidtarsal,
    LMetatarsal,
    Lumbar,
    Thoracic,
    RScapula,
    RShoulder,
    RElbow,
    RWrist,
    RIndex0,
    RIndex1,
    RIndex2,
    RMiddle0,
    RMiddle1,
    RMiddle2,
    RRing0,
    RRing1,
    RRing2,
    RPinky0,
    RPinky1,
    RPinky2,
    RThumb0,
    RThumb1,
    RThumb2,
    LScapula,
    LShoulder,
    LElbow,
    LWrist,
    LIndex0,
    LIndex1,
    LIndex2,
    LMiddle0,
    LMiddle1,
    LMiddle2,
    LRing0,
    LRing1,
    LRing2,
    LPinky0,
    LPinky1,
    LPinky2,
    LThumb0,
    LThumb1,
    LThumb2,
    Cervical,
    Skull,
    Chin,
}

/// Row of GEVH table A.1, as printed: name, parent and zero frame of a bone.
struct Row {
    name: &'static str,
    parent: Option<usize>,
    /// The table's column "Hand": rows marked R have the z components of all axes negated.
    flip_z: bool,
    /// Euler angles Z-Y-Z in the table's last place, 1e-4 degrees: whole numbers compress to half
    /// the size of fractions in the page's download.
    euler_zyz_places: [i32; 3],
    /// Position of the male example in hundredths of skeleton units (inch-like), x left,
    /// y up, z back.
    position_places: [i16; 3],
}

impl Row {
    fn euler_zyz_deg(&self) -> [f64; 3] {
        self.euler_zyz_places.map(|x| f64::from(x) / 1e4)
    }

    fn position_units(&self) -> [f64; 3] {
        self.position_places.map(|x| f64::from(x) / 1e2)
    }
}

/// Returns the integer nearest to `x`; halves are rounded away from zero.
#[expect(clippy::cast_possible_truncation, reason = "small")]
const fn nearest(x: f64) -> i32 {
    (if x < 0.0 { x - 0.5 } else { x + 0.5 }) as i32
}

const fn row(
    name: &'static str,
    parent: Option<usize>,
    flip_z: bool,
    [a, b, c]: [f64; 3],
    [x, y, z]: [f64; 3],
) -> Row {
    Row {
        name,
        parent,
        flip_z,
        euler_zyz_places: [nearest(a * 1e4), nearest(b * 1e4), nearest(c * 1e4)],
        position_places: [
            nearest(x * 1e2) as i16,
            nearest(y * 1e2) as i16,
            nearest(z * 1e2) as i16,
        ],
    }
}

/// GEVH tables A.1 and A.2. `bone_chin` has no row in A.1 and takes its parent's frame; the lost
/// separator of `bone_r_middle2` is restored.
#[rustfmt::skip]
static ROWS: [Row; Bone::COUNT] = [
    row("bone_sacroiliac", None, false, [178.7079, 90.0, -90.0], [-0.13, 37.82, 0.0]),
    row("bone_r_hip", Some(0), true, [-83.8065, 178.1118, -173.798], [-3.89, 44.43, 0.68]),
    row("bone_r_knee", Some(1), true, [88.2029, 173.5071, -1.804], [-3.89, 20.11, -0.12]),
    row("bone_r_subtalar", Some(2), true, [-89.758, 143.5556, -179.8095], [-3.89, 4.89, 1.61]),
    row("bone_r_midtarsal", Some(3), true, [-89.924, 91.1118, 179.9998], [-3.89, 1.22, -1.1]),
    row("bone_r_metatarsal", Some(4), true, [-89.924, 96.0126, 179.9996], [-3.89, 1.16, -4.47]),
    row("bone_l_hip", Some(0), false, [-96.1374, 1.8407, 6.1522], [3.89, 44.43, 0.68]),
    row("bone_l_knee", Some(6), false, [91.7311, 6.5409, 178.269], [3.89, 20.11, -0.1]),
    row("bone_l_subtalar", Some(7), false, [-90.2381, 36.4449, 0.1221], [3.89, 4.89, 1.64]),
    row("bone_l_midtarsal", Some(8), false, [-90.1413, 88.8054, 0.0031], [3.88, 1.22, -1.06]),
    row("bone_l_metatarsal", Some(9), false, [-90.1416, 83.9045, 0.0049], [3.88, 1.15, -4.44]),
    row("bone_lumbar", Some(0), false, [-179.6485, 89.9992, -90.0], [0.04, 45.07, 0.0]),
    row("bone_thoracic", Some(11), false, [179.8697, 90.0, -90.0], [-0.02, 53.96, 0.0]),
    row("bone_r_scapula", Some(12), true, [104.55, 90.0, 90.0], [-0.91, 64.17, 1.46]),
    row("bone_r_shoulder", Some(13), true, [89.3726, 90.0, 89.999], [-7.24, 62.52, 1.46]),
    row("bone_r_elbow", Some(14), true, [89.9871, 90.0001, 89.999], [-19.76, 62.66, 1.46]),
    row("bone_r_wrist", Some(15), true, [93.8431, 90.0002, 89.999], [-30.1, 62.66, 1.46]),
    row("bone_r_index0", Some(16), true, [179.9871, 163.3189, -180.0], [-33.28, 62.81, -0.05]),
    row("bone_r_index1", Some(17), true, [179.9871, 163.1309, -180.0], [-34.98, 62.81, -0.56]),
    row("bone_r_index2", Some(18), true, [179.9873, 163.131, -179.9998], [-36.33, 62.81, -0.96]),
    row("bone_r_middle0", Some(16), true, [179.9875, 172.9396, -180.0], [-33.59, 62.81, 0.86]),
    row("bone_r_middle1", Some(20), true, [179.9875, 172.7565, -180.0], [-35.39, 62.81, 0.64]),
    row("bone_r_middle2", Some(21), true, [179.9881, 172.7565, -179.9995], [-36.97, 62.81, 0.44]),
    row("bone_r_ring0", Some(16), true, [179.9871, 173.7635, -180.0], [-33.6, 62.61, 1.85]),
    row("bone_r_ring1", Some(23), true, [179.9871, 173.5668, -180.0], [-35.28, 62.61, 1.66]),
    row("bone_r_ring2", Some(24), true, [179.9871, 173.5668, -180.0], [-36.61, 62.61, 1.51]),
    row("bone_r_pinky0", Some(16), true, [179.987, 177.7818, -179.9999], [-33.59, 62.21, 2.65]),
    row("bone_r_pinky1", Some(26), true, [179.987, 177.4742, -179.9999], [-34.67, 62.21, 2.61]),
    row("bone_r_pinky2", Some(27), true, [179.987, 177.4742, -179.9999], [-35.67, 62.21, 2.56]),
    row("bone_r_thumb0", Some(16), true, [179.987, 139.5749, 154.3371], [-31.37, 61.41, 0.18]),
    row("bone_r_thumb1", Some(29), true, [175.464, 144.9105, 150.7566], [-32.36, 60.79, -0.66]),
    row("bone_r_thumb2", Some(30), true, [175.464, 144.9105, 150.7566], [-33.02, 60.41, -1.11]),
    row("bone_l_scapula", Some(12), false, [75.4502, 90.0, -90.0], [0.91, 64.17, 1.46]),
    row("bone_l_shoulder", Some(32), false, [90.623, 90.0, -89.9994], [7.23, 62.52, 1.46]),
    row("bone_l_elbow", Some(33), false, [90.0086, 90.0, -89.9994], [19.76, 62.66, 1.46]),
    row("bone_l_wrist", Some(34), false, [86.1526, 89.9999, -89.9994], [30.1, 62.66, 1.46]),
    row("bone_l_index0", Some(35), false, [0.0086, 16.6826, 0.0], [33.28, 62.81, -0.05]),
    row("bone_l_index1", Some(36), false, [0.0086, 16.8705, 0.0], [34.98, 62.81, -0.56]),
    row("bone_l_index2", Some(37), false, [0.0084, 16.8705, 0.0001], [36.32, 62.81, -0.97]),
    row("bone_l_middle0", Some(35), false, [0.0084, 7.062, -0.0001], [33.59, 62.81, 0.86]),
    row("bone_l_middle1", Some(39), false, [0.0084, 7.2452, -0.0001], [35.39, 62.81, 0.63]),
    row("bone_l_middle2", Some(40), false, [0.0079, 7.2452, 0.0003], [36.97, 62.81, 0.43]),
    row("bone_l_ring0", Some(35), false, [0.0088, 6.2382, -0.0001], [33.59, 62.61, 1.85]),
    row("bone_l_ring1", Some(42), false, [0.0087, 6.4349, -0.0001], [35.28, 62.61, 1.66]),
    row("bone_l_ring2", Some(43), false, [0.0087, 6.4349, -0.0001], [36.61, 62.61, 1.51]),
    row("bone_l_pinky0", Some(35), false, [0.009, 2.2198, -0.0004], [33.59, 62.21, 2.65]),
    row("bone_l_pinky1", Some(45), false, [0.0089, 2.5288, -0.0003], [34.67, 62.21, 2.61]),
    row("bone_l_pinky2", Some(46), false, [0.0089, 2.5288, -0.0003], [35.67, 62.21, 2.56]),
    row("bone_l_thumb0", Some(35), false, [0.0086, 40.4267, -25.6629], [31.37, 61.41, 0.17]),
    row("bone_l_thumb1", Some(48), false, [4.5315, 35.0912, -29.2432], [32.35, 60.79, -0.67]),
    row("bone_l_thumb2", Some(49), false, [4.5315, 35.0912, -29.2432], [33.02, 60.41, -1.11]),
    row("bone_cervical", Some(12), false, [179.964, 90.0019, -90.0369], [0.0, 64.11, 0.0]),
    row("bone_skull", Some(51), false, [179.9038, 90.0039, -90.033], [0.01, 68.99, 0.0]),
    row("bone_chin", Some(52), false, [179.9038, 90.0039, -90.033], [0.01, 68.99, 0.0]),];

impl Bone {
    /// Number of bones in the skeleton of GEVH appendix A.
    pub const COUNT: usize = 54;

    /// All bones, parents before children.
    pub const ALL: [Self; Self::COUNT] = [
        Self::Sacroiliac,
        Self::RHip,
        Self::RKnee,
        Self::RSubtalar,
        Self::RMidtarsal,
        Self::RMetatarsal,
        Self::LHip,
        Self::LKnee,
        Self::LSubtalar,
        Self::LMidtarsal,
        Self::LMetatarsal,
        Self::Lumbar,
        Self::Thoracic,
        Self::RScapula,
        Self::RShoulder,
        Self::RElbow,
        Self::RWrist,
        Self::RIndex0,
        Self::RIndex1,
        Self::RIndex2,
        Self::RMiddle0,
        Self::RMiddle1,
        Self::RMiddle2,
        Self::RRing0,
        Self::RRing1,
        Self::RRing2,
        Self::RPinky0,
        Self::RPinky1,
        Self::RPinky2,
        Self::RThumb0,
        Self::RThumb1,
        Self::RThumb2,
        Self::LScapula,
        Self::LShoulder,
        Self::LElbow,
        Self::LWrist,
        Self::LIndex0,
        Self::LIndex1,
        Self::LIndex2,
        Self::LMiddle0,
        Self::LMiddle1,
        Self::LMiddle2,
        Self::LRing0,
        Self::LRing1,
        Self::LRing2,
        Self::LPinky0,
        Self::LPinky1,
        Self::LPinky2,
        Self::LThumb0,
        Self::LThumb1,
        Self::LThumb2,
        Self::Cervical,
        Self::Skull,
        Self::Chin,
    ];

    /// Returns the index of the bone in [`Bone::ALL`], 0 to 53.
    #[must_use]
    pub fn index(self) -> usize {
        self as usize
    }

    /// Returns the name of the bone in GEVH, for example `bone_r_wrist`.
    #[must_use]
    pub fn name(self) -> &'static str {
        ROWS[self.index()].name
    }

    /// Returns the parent bone; `None` for the sacroiliac.
    #[must_use]
    pub fn parent(self) -> Option<Self> {
        ROWS[self.index()].parent.map(|i| Self::ALL[i])
    }

    /// Finds a bone by name, with or without the `bone_` prefix.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        let bare = name.strip_prefix("bone_").unwrap_or(name);
        Self::ALL.into_iter().find(|b| &b.name()[5..] == bare)
    }

    /// Returns the side of the body, or `None` on the midline.
    #[must_use]
    pub fn side(self) -> Option<Side> {
        match &self.name()[5..7] {
            "l_" => Some(Side::Left),
            "r_" => Some(Side::Right),
            _ => None,
        }
    }

    /// Returns the same bone on the other side; the bone itself on the midline.
    #[must_use]
    pub fn mirrored(self) -> Self {
        let name = match self.side() {
            None => return self,
            Some(Side::Left) => self.name().replacen("_l_", "_r_", 1),
            Some(Side::Right) => self.name().replacen("_r_", "_l_", 1),
        };
        Self::from_name(&name).unwrap_or(self)
    }

    /// Returns the bone of one side by its name without the side, for example `wrist`.
    ///
    /// # Panics
    /// Panics if the bone does not exist; names come from code, not from input.
    #[must_use]
    #[allow(clippy::expect_used, reason = "called with literals only")]
    pub fn on(side: Side, part: &str) -> Self {
        let letter = if side == Side::Left { 'l' } else { 'r' };
        Self::from_name(&format!("{letter}_{part}")).expect("a bone of appendix A")
    }

    /// Returns the position of the bone in the male example of table A.1, engine frame, metres (one
    /// unit is 25.4 mm), symmetrised from the left side.
    #[must_use]
    pub fn example_position_m(self) -> DVec3 {
        let source = if self.side() == Some(Side::Right) {
            self.mirrored()
        } else {
            self
        };
        let [x, y, z] = ROWS[source.index()].position_units();
        let p = DVec3::new(x, y, -z) * raconteur_base::METRES_PER_INCH;
        match self.side() {
            None => DVec3::new(0.0, p.y, p.z),
            Some(Side::Left) => p,
            Some(Side::Right) => mirror_vector(p),
        }
    }
}

/// Axes of a row in the engine frame, as columns; improper (left-handed) because the
/// source is.
fn source_axes(row: &Row) -> DMat3 {
    let [a, b, c] = row.euler_zyz_deg().map(f64::to_radians);
    let m = DMat3::from_rotation_z(a) * DMat3::from_rotation_y(b) * DMat3::from_rotation_z(c);
    // The source's z points back; rows of the right hand are negated again.
    let z_sign = if row.flip_z { 1.0 } else { -1.0 };
    let turn = |v: DVec3| DVec3::new(v.x, v.y, z_sign * v.z);
    DMat3::from_cols(turn(m.x_axis), turn(m.y_axis), turn(m.z_axis))
}

/// Returns the orientation of every bone in the zero pose, world from bone.
///
/// The table rows of midline bones lie within 1.3° of upright (noise of the example skeleton) and
/// are set upright. The right side mirrors the left.
#[must_use]
pub fn zero_frames() -> [DQuat; Bone::COUNT] {
    Bone::ALL.map(|bone| {
        let left = if bone.side() == Some(Side::Right) {
            bone.mirrored()
        } else {
            bone
        };
        let axes = match bone.side() {
            None => DMat3::from_cols(DVec3::Y, DVec3::Z, DVec3::X),
            Some(side) => {
                let m = source_axes(&ROWS[left.index()]);
                let (x, y) = match side {
                    Side::Left => (m.x_axis, m.y_axis),
                    Side::Right => (mirror_vector(m.x_axis), mirror_vector(m.y_axis)),
                };
                DMat3::from_cols(x, y, x.cross(y))
            }
        };
        DQuat::from_mat3(&axes).normalized()
    })
}
