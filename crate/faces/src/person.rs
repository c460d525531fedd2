//! Records of the people of faces.

/// Record of the person of a database face (F&H 5.1.1): sex, age and ancestry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PersonRecord {
    /// 0 male to 1 female.
    pub sex: f64,
    /// Age, years.
    pub age_years: f64,
    /// Shares of European, Asian and African ancestry.
    pub ancestry: [f64; 3],
}
