//! `body-configure-manipulator`: switches a manipulator.

use super::common::MANIPULATOR;
use super::{Attribute, Context, Element, Fields, Kind};
use crate::{ClauseKind, ConfigureManipulator, Diagnostic};

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Switches a manipulator and its joint limits."),
    decision: super::reference_text("The manipulators are leftArm, rightArm, leftLeg, rightLeg and head; omitted attributes stay unchanged. Of several solutions for a target, the most accurate is chosen, then the one with the least joint variation. Preferred joints are the third filter of GEVH 3.3.2.1 and take precedence over comfort: they determine where elbow or knee point."),
    source: super::reference_text("GEVH D.3.19, 3.3.2.1"),
    example: super::reference_text("<body-configure-manipulator time='0' manipulator='leftArm' isOn='true' jointLimitsActive='false'/>"),
    attributes: &[
        MANIPULATOR,
        Attribute::flag("isOn", "Whether it drives its limb.").aliases(&["is0n"]),
        Attribute::flag("jointLimitsActive", "Whether its joints have limits."),
        Attribute::new(
            "preferred",
            Kind::Numbers,
            "Preferred joint angles, j1 to j6 as in body-non-deterministic-fk; the first few are enough. Of several ways to reach a target, the limb takes the nearest to them. An empty value returns the choice to the limb.",
        )
        .unit("°")
        .extension(),
    ],
    ..Element::clause("body-configure-manipulator", build)
};

fn build(cx: &mut Context<'_>, node: usize, fields: &Fields<'_>) -> Option<ClauseKind> {
    let mut configure = ConfigureManipulator::default();
    if !cx.record(node, fields, &mut configure) {
        return None;
    }
    let joints = configure.manipulator.joints();
    if let Some(preferred) = &mut configure.preferred_deg
        && preferred.len() > joints
    {
        let message = format!(
            "{} has {joints} joints, not {}",
            configure.manipulator.word(),
            preferred.len()
        );
        let span = fields.span_of("preferred");
        cx.sink
            .push(Diagnostic::warning("eml::surplus-joints", span, message));
        preferred.truncate(joints);
    }
    Some(ClauseKind::ConfigureManipulator(configure))
}

#[cfg(test)]
mod tests {
    use crate::schema::testing::{clause_codes, one};
    use crate::{ClauseKind, Manipulator};

    #[test]
    fn switches_are_kept() {
        let kind = one(
            "<body-configure-manipulator time='0' manipulator='rightLeg' jointLimitsActive='0'/>",
        );
        let ClauseKind::ConfigureManipulator(c) = kind else {
            panic!("{kind:?}")
        };
        assert_eq!(c.manipulator, Manipulator::RightLeg);
        assert_eq!((c.is_on, c.joint_limits_active), (None, Some(false)));
    }

    #[test]
    fn preferred_joints_are_kept_as_far_as_there_are_joints() {
        let text = |n: &str| {
            format!(
                "<eml xmlns:x='urn:raconteur:eml:1'><body><body-configure-manipulator time='0' \
                 manipulator='head' x:preferred='{n}'/></body></eml>"
            )
        };
        let preferred = |n: &str| {
            let parsed = crate::parse(&text(n));
            let ClauseKind::ConfigureManipulator(c) = &parsed.document.clauses[0].kind else {
                panic!()
            };
            let codes: Vec<_> = parsed.diagnostics.iter().map(|d| d.code).collect();
            (c.preferred_deg.clone(), codes)
        };
        assert_eq!(preferred("30 -20.5"), (Some(vec![30.0, -20.5]), vec![]));
        assert_eq!(preferred(""), (Some(vec![]), vec![]));
        let (kept, codes) = preferred("1 2 3 4 5 6 7");
        assert_eq!(kept.map(|k| k.len()), Some(5));
        assert_eq!(codes, ["eml::surplus-joints"]);
    }

    #[test]
    fn only_known_limbs_are_manipulators() {
        assert_eq!(
            clause_codes("<body-configure-manipulator time='0' manipulator='tail'/>"),
            ["eml::bad-choice"]
        );
    }
}
