//! Named sets of tracks, and named references of clauses (GEVH D.3.3, D.3.7 to D.3.13).

use crate::Span;
use crate::record::{Child, Record, Visit, words};

/// The body groups that every figure has (GEVH fig. 3.3; the legs are assumed).
pub const BODY_GROUPS: &[&str] = &[
    "head",
    "torso",
    "left_arm",
    "right_arm",
    "left_hand",
    "right_hand",
    "left_leg",
    "right_leg",
];

/// The bones that every figure has (GEVH appendix A), without the `bone_` before their names.
pub const BONES: &[&str] = &[
    "sacroiliac",
    "r_hip",
    "r_knee",
    "r_subtalar",
    "r_midtarsal",
    "r_metatarsal",
    "l_hip",
    "l_knee",
    "l_subtalar",
    "l_midtarsal",
    "l_metatarsal",
    "lumbar",
    "thoracic",
    "r_scapula",
    "r_shoulder",
    "r_elbow",
    "r_wrist",
    "r_index0",
    "r_index1",
    "r_index2",
    "r_middle0",
    "r_middle1",
    "r_middle2",
    "r_ring0",
    "r_ring1",
    "r_ring2",
    "r_pinky0",
    "r_pinky1",
    "r_pinky2",
    "r_thumb0",
    "r_thumb1",
    "r_thumb2",
    "l_scapula",
    "l_shoulder",
    "l_elbow",
    "l_wrist",
    "l_index0",
    "l_index1",
    "l_index2",
    "l_middle0",
    "l_middle1",
    "l_middle2",
    "l_ring0",
    "l_ring1",
    "l_ring2",
    "l_pinky0",
    "l_pinky1",
    "l_pinky2",
    "l_thumb0",
    "l_thumb1",
    "l_thumb2",
    "cervical",
    "skull",
    "chin",
];

/// Returns the number of a layer from its name, which ends in it (`layer1`) or is it (`1`); `None`
/// for any other name.
#[must_use]
pub fn layer_number(name: &str) -> Option<usize> {
    let digits = name.trim_start_matches(|c: char| !c.is_ascii_digit());
    digits.parse().ok()
}

words! {
    /// Kind of a set's members.
    SetKind {
        /// Layers of a player.
        Multiple = "multiple",
        /// Body groups.
        BodyGroup = "bodyGroup",
    }
}

/// Named set of tracks that clauses refer to (GEVH D.3.3).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Set {
    /// Name of the set.
    pub name: String,
    /// Kind of its members.
    pub kind: SetKind,
    /// Members of the set in order, [`MemberKind::Item`] and [`MemberKind::Set`].
    pub members: Vec<Member>,
    /// Span of the start tag.
    pub span: Span,
}

impl Record for Set {
    fn element(&self) -> &'static str {
        "set"
    }

    fn visit(&mut self, visitor: &mut dyn Visit) {
        visitor.field("type", &mut self.kind);
        visitor.field("name", &mut self.name);
        visitor.children(&mut self.members);
    }
}

/// Kind of a [`Member`]: item, set, group, layer or bone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MemberKind {
    /// `it`: a body group or a layer of a set.
    Item,
    /// `ref`: a named set.
    Set,
    /// `bg`: a body group.
    Group,
    /// `ly`: a layer, by name or number.
    Layer,
    /// `bone`: one bone.
    Bone,
}

impl MemberKind {
    const ELEMENTS: [(&'static str, Self); 5] = [
        ("it", Self::Item),
        ("ref", Self::Set),
        ("bg", Self::Group),
        ("ly", Self::Layer),
        ("bone", Self::Bone),
    ];

    /// Returns the name of the EML element for this kind of member.
    #[must_use]
    pub fn element(self) -> &'static str {
        Self::ELEMENTS[self as usize].0
    }
}

/// Member of a set, a list of tracks or a list of bones.
#[derive(Clone, Debug, PartialEq)]
pub struct Member {
    /// Kind of the member.
    pub kind: MemberKind,
    /// Name of the member; digits for a layer, a bone name without `bone_`.
    pub name: String,
}

impl Record for Member {
    fn element(&self) -> &'static str {
        self.kind.element()
    }

    fn visit(&mut self, visitor: &mut dyn Visit) {
        visitor.field("name", &mut self.name);
        if self.kind == MemberKind::Layer {
            let mut index: Option<u32> = None;
            visitor.field("index", &mut index);
            if let (true, Some(index)) = (self.name.is_empty(), index) {
                self.name = index.to_string();
            }
        }
        if self.kind == MemberKind::Bone
            && let Some(short) = self.name.strip_prefix("bone_")
        {
            self.name = short.to_owned();
        }
    }
}

impl Child for Member {
    fn blank(element: &str) -> Option<Self> {
        let (_, kind) = MemberKind::ELEMENTS
            .iter()
            .find(|(name, _)| *name == element)?;
        Some(Self {
            kind: *kind,
            name: String::new(),
        })
    }
}

/// Resolves the set `name`: its items and those of the sets that it references, each once, in
/// order. Cycles are not followed; an unknown set is empty.
#[must_use]
pub fn items_of<'s>(sets: &'s [Set], name: &str) -> Vec<&'s str> {
    let mut items = Vec::new();
    let mut seen = vec![false; sets.len()];
    let find = |name: &str| sets.iter().position(|s| s.name == name);
    // Each entry is a set and the index of its next member.
    let mut stack: Vec<(usize, usize)> = find(name).map(|set| (set, 0)).into_iter().collect();
    while let Some((set, next)) = stack.last_mut() {
        seen[*set] = true;
        let Some(member) = sets[*set].members.get(*next) else {
            stack.pop();
            continue;
        };
        *next += 1;
        if member.kind != MemberKind::Set {
            if !items.contains(&member.name.as_str()) {
                items.push(member.name.as_str());
            }
        } else if let Some(inner) = find(&member.name).filter(|&inner| !seen[inner]) {
            stack.push((inner, 0));
        }
    }
    items
}
