//! Mapping from a point in the emotion space to the weights of the basic expressions: by the disc
//! of activation and evaluation (F&H equations 4.6 to 4.10), or by the sphere that also includes
//! power, which F&H section 4.4.4 proposes.

use raconteur_base::ops;
use raconteur_base::{DVec3, Length, curve::smooth};
use raconteur_speech::emotion::{self, EmotionPoint};

use super::basic::{BASICS, BasicEmotion};
use super::expression::Expression;
use super::look::{self, BASE_EXPRESSIONS, BaseExpression};

/// Emotion space in which neighbouring basic emotions are blended into an expression.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum EmotionSpace {
    /// Activation and evaluation (F&H section 4.4.3).
    Disc,
    /// Sphere of activation, evaluation and power (F&H section 4.4.4).
    #[default]
    Sphere,
}

/// Emotion to express: its position in the emotion space, its word, if any, and the space used to
/// blend its expression.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Affect {
    /// Place in the emotion space.
    pub place: EmotionPoint,
    /// Its word in [`raconteur_speech::emotion::WORDS`], which may have an expression of its own.
    pub word: Option<&'static str>,
    /// Space in which the expression is blended from the basic ones.
    pub space: EmotionSpace,
}

impl Affect {
    /// Returns the emotion of a word; `None` for an unknown word.
    #[must_use]
    pub fn named(word: &str) -> Option<Self> {
        let (own, _) = emotion::WORDS
            .iter()
            .find(|(own, _)| own.eq_ignore_ascii_case(word))?;
        Some(Self {
            place: emotion::place(own)?,
            word: Some(own),
            space: EmotionSpace::default(),
        })
    }

    /// Returns the emotion of a place without a word.
    #[must_use]
    pub fn from_point(place: EmotionPoint) -> Self {
        Self {
            place,
            ..Self::default()
        }
    }
}

/// A basic emotion counts among the neighbours of a direction while the nearest is more than
/// this much as near, measured by the tangents of half their angles. Designed.
const FAR: f64 = 0.3;

/// Weight of each basic emotion when it is near: disgust and anger lie in one direction (2° apart),
/// so together they count as one. Designed.
const COUNTS: [f64; BASICS] = [1.0, 1.0, 0.5, 0.5, 1.0, 1.0];

/// Weights of the base expressions in an expression, indexed by [`BaseExpression::ALL`]: the basic
/// ones first, in the order of [`BasicEmotion::ALL`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ExpressionWeights {
    /// Weights for muscles without antagonists and for all other controls.
    pub free: [f64; BASE_EXPRESSIONS],
    /// Weights for muscles with antagonists, before opposing muscles are balanced.
    pub bound: [f64; BASE_EXPRESSIONS],
}

/// Returns polar coordinates on the activation-evaluation disc: the angle from full evaluation
/// towards full activation, radians, and the distance from the centre.
#[must_use]
pub fn polar(place: EmotionPoint) -> [f64; 2] {
    [
        ops::atan2(place.activation, place.evaluation),
        ops::hypot(place.activation, place.evaluation),
    ]
}

impl ExpressionWeights {
    /// Returns one basic emotion, scaled by the ratio of distances from the centre of the disc (F&H
    /// equations 4.6 and 4.7).
    #[must_use]
    pub fn scaled(basic: BasicEmotion, ratio: f64) -> Self {
        let mut mixture = Self::default();
        mixture.free[basic as usize] = ratio;
        mixture.bound[basic as usize] = ratio;
        mixture
    }

    /// Blends two basic emotions as printed in F&H (equations 4.8 to 4.10). `share` of the second,
    /// 0 to 1: (ω − ω₁) / (ω₂ − ω₁) by angles; `ratios`: distances from the centre relative to each
    /// emotion's own.
    ///
    /// Muscles with antagonists take the plain sums of equation 4.10 regardless of the share, so
    /// they jump where another basic emotion becomes a neighbour. [`ExpressionWeights::on_disc`]
    /// fixes that.
    #[must_use]
    pub fn printed(between: [BasicEmotion; 2], share: f64, ratios: [f64; 2]) -> Self {
        let mut mixture = Self::default();
        for (k, weight) in [1.0 - share, share].into_iter().enumerate() {
            mixture.free[between[k] as usize] += weight * ratios[k];
            mixture.bound[between[k] as usize] += ratios[k];
        }
        mixture
    }

    /// Returns the expression of a place on the disc, whatever its power, from the two neighbours
    /// by angle. In the sums of equation 4.10 the farther neighbour fades by the ratio of the
    /// shares: midway between the two the equation holds as printed, at either one equation 4.7,
    /// and the transition is continuous.
    #[must_use]
    pub fn on_disc(place: EmotionPoint) -> Self {
        let [angle, radius] = polar(place);
        if !(radius > 0.0 && radius.is_finite()) {
            return Self::default();
        }
        let turned = |from: f64, to: f64| {
            let turn = ops::wrap_angle(to - from);
            if turn < 0.0 {
                turn + core::f64::consts::TAU
            } else {
                turn
            }
        };
        let ends = BasicEmotion::ALL.map(|basic| polar(basic.place()));
        // The last basic emotion that the turn has passed is the first neighbour.
        let mut first = BASICS - 1;
        for i in 0..BASICS {
            if turned(ends[i][0], angle) < turned(ends[first][0], angle) {
                first = i;
            }
        }
        let second = (first + 1) % BASICS;
        let sector = turned(ends[first][0], ends[second][0]);
        let share = (turned(ends[first][0], angle) / sector).clamp(0.0, 1.0);
        let ratios = [radius / ends[first][1], radius / ends[second][1]];
        let between = [BasicEmotion::ALL[first], BasicEmotion::ALL[second]];
        let mut mixture = Self::printed(between, share, ratios);
        let most = share.max(1.0 - share);
        mixture.bound[first] *= (1.0 - share) / most;
        mixture.bound[second] *= share / most;
        mixture
    }

    /// Returns the expression of a place by its direction on the sphere, from the near neighbours,
    /// scaled by its distance from the middle. The nearest dominates; the others contribute by
    /// their relative nearness. Sums of equation 4.10 fade as they do on the disc.
    #[must_use]
    pub fn on_sphere(place: EmotionPoint) -> Self {
        let sites = BasicEmotion::ALL.map(|basic| vector(basic.place()));
        let length = vector(place).magnitude();
        let mut near = COUNTS;
        nearness(vector(place), &sites, &mut near);
        let sum: f64 = near.iter().sum();
        let most = near.iter().fold(0.0, |a: f64, n| a.max(*n));
        let mut mixture = Self::default();
        if sum > 0.0 {
            for i in 0..BASICS {
                let ratio = length / sites[i].magnitude();
                mixture.free[i] = ratio * near[i] / sum;
                mixture.bound[i] = ratio * near[i] / most;
            }
        }
        mixture
    }

    /// Returns the expression of a place in a space.
    #[must_use]
    pub fn from_point(place: EmotionPoint, space: EmotionSpace) -> Self {
        match space {
            EmotionSpace::Disc => Self::on_disc(place),
            EmotionSpace::Sphere => Self::on_sphere(place),
        }
    }

    /// Returns the expression of an emotion. A word with an expression of its own uses it on the
    /// sphere; on the disc every emotion is blended from the six basic ones by its place, as in
    /// F&H.
    #[must_use]
    pub fn from_affect(affect: Affect) -> Self {
        let looks = affect.word.and_then(look::of_word);
        match looks.filter(|_| affect.space == EmotionSpace::Sphere) {
            Some(looks) => {
                let mut mixture = Self::default();
                for (look, share) in looks {
                    mixture.free[look.index()] = *share;
                    mixture.bound[look.index()] = *share;
                }
                mixture
            }
            None => Self::from_point(affect.place, affect.space),
        }
    }

    /// Returns the weights without the wink, and the amount of wink in them.
    pub(super) fn split_wink(mut self) -> (Self, f64) {
        let wink = BaseExpression::Wink.index();
        self.bound[wink] = 0.0;
        let amount = core::mem::take(&mut self.free[wink]);
        (self, amount)
    }

    /// Adds so much of a wink.
    pub(super) fn wink(&mut self, amount: f64) {
        let wink = BaseExpression::Wink.index();
        self.free[wink] += amount;
        self.bound[wink] += amount;
    }

    /// Makes it stronger or weaker by a factor (F&H equation 4.7).
    pub fn scale(&mut self, factor: f64) {
        let own = core::mem::take(self);
        self.add(&own, factor);
    }

    /// Adds so much of another.
    pub(super) fn add(&mut self, other: &Self, factor: f64) {
        for i in 0..BASE_EXPRESSIONS {
            self.free[i] += factor * other.free[i];
            self.bound[i] += factor * other.bound[i];
        }
    }

    /// Returns the face controls: antagonists balanced against each other, all values within their
    /// range.
    #[must_use]
    pub fn expression(&self) -> Expression {
        let mut expression = Expression::default();
        for (i, look) in BaseExpression::ALL.into_iter().enumerate() {
            let (free, bound) = (self.free[i], self.bound[i]);
            if free != 0.0 || bound != 0.0 {
                expression.gather(look, free, bound);
            }
        }
        expression.settle();
        expression.limit();
        expression
    }
}

/// Returns a place as a vector.
pub(super) fn vector(place: EmotionPoint) -> DVec3 {
    DVec3::new(place.evaluation, place.activation, place.power)
}

/// Computes the nearness of sites to a direction: multiplies each entry of `near` by 1 for the
/// nearest and by less for those farther, down to 0. In the direction of a site, all others are 0;
/// in the middle of the space, which has no direction, all are 0.
pub(super) fn nearness(direction: DVec3, sites: &[DVec3], near: &mut [f64]) {
    let Some(direction) = direction.try_normalized() else {
        near.fill(0.0);
        return;
    };
    // The tangent of half the angle to a site; infinite on the other side.
    let away = |site: &DVec3| {
        let site = site.normalize_or_zero();
        (direction - site).magnitude() / (direction + site).magnitude()
    };
    let nearest = sites.iter().map(away).fold(f64::INFINITY, f64::min);
    for (near, site) in near.iter_mut().zip(sites) {
        let away = away(site);
        let ratio = if away > nearest { nearest / away } else { 1.0 };
        *near *= smooth((ratio - FAR) / (1.0 - FAR));
    }
}
