//! Statistics of human heads: mean and standard deviation of a distance for a sex and an age.
//!
//! The source is a small table condensed from surveys. Each row contains the adult mean at 30 and
//! its deviation for men and women, the share of it at nine years, and the change per year after
//! 30.
//! Means of adults are *measured*; shares of children are measured where a growth curve exists and
//! otherwise *designed* after general proportions; changes with age are measured where ANSUR II
//! gives a slope, otherwise designed.
//!
//! Sources: ANSUR II public data (Gordon et al. 2014, US Army, n = 4082 men, 1986 women; means
//! computed by this project); US respirator users (Zhuang et al. 2010, doi:10.1093/annhyg/meq007);
//! 3D Facial Norms growth curves of European Americans (Weinberg et al. 2016, doi:10.1597/15-199)
//! as smoothed by Cliniface, value at 25; Farkas 1994 for fissure height and mandible. Each row of
//! the table names its own source.

/// Publication from which the adult values of a [`Row`] are taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// ANSUR II.
    Ansur,
    /// Zhuang et al. 2010.
    Respirator,
    /// Weinberg et al. 2016.
    FacialNorms,
    /// Farkas 1994.
    Farkas,
    /// Heinz et al. 2003.
    Heinz,
    /// Mean of Zhuang et al. 2010 and Weinberg et al. 2016, whose gonia lie 16 mm apart.
    JawMean,
}

impl Source {
    /// Returns a short citation of the publication.
    #[must_use]
    pub fn citation(self) -> &'static str {
        match self {
            Self::Ansur => "ANSUR II 2012",
            Self::Respirator => "Zhuang et al. 2010, doi:10.1093/annhyg/meq007",
            Self::FacialNorms => "Weinberg et al. 2016, doi:10.1597/15-199",
            Self::Farkas => "Farkas 1994",
            Self::Heinz => "Heinz et al. 2003, doi:10.1080/10691898.2003.11910711",
            Self::JawMean => "mean of Zhuang et al. 2010 and Weinberg et al. 2016",
        }
    }
}

/// Population statistics of one measure, millimetres. Pairs are men and women.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// Adult mean at 30.
    pub mean: [f64; 2],
    /// Standard deviations of men and women.
    pub sd: [f64; 2],
    /// Share of the adult mean at nine.
    pub at_nine: [f64; 2],
    /// Change a year after 30.
    pub per_year: [f64; 2],
    /// Source of mean and deviation.
    pub source: Source,
}

/// Mean and standard deviation of one distance for a sex and an age, millimetres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Norm {
    /// Mean, millimetres.
    pub mean: f64,
    /// Standard deviation, millimetres.
    pub sd: f64,
}

impl Row {
    pub(crate) const fn new(
        mean: [f64; 2],
        sd: [f64; 2],
        at_nine: [f64; 2],
        per_year: [f64; 2],
        source: Source,
    ) -> Self {
        Self {
            mean,
            sd,
            at_nine,
            per_year,
            source,
        }
    }

    /// Returns the norm for a sex (0 male to 1 female) and an age in years. Between nine and 18 it
    /// grows linearly, as the published curves do within their scatter.
    #[must_use]
    pub fn norm_at(&self, sex: f64, age_years: f64) -> Norm {
        let one = |i: usize| {
            let grown = ((age_years - 9.0) / 9.0).clamp(-0.12, 1.0);
            let share = self.at_nine[i] + (1.0 - self.at_nine[i]) * grown;
            let aged = self.per_year[i] * (age_years - 30.0).clamp(0.0, 50.0);
            Norm {
                mean: self.mean[i] * share + aged,
                sd: self.sd[i] * (0.5 + 0.5 * share),
            }
        };
        let (m, f) = (one(0), one(1));
        Norm {
            mean: m.mean + (f.mean - m.mean) * sex,
            sd: m.sd + (f.sd - m.sd) * sex,
        }
    }
}
