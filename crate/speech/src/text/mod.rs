//! Text as it is written, turned into text as it is spoken.

/// The order of the parts of a date.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// Day, month, year.
    Dmy,
    /// Month, day, year.
    Mdy,
    /// Year, month, day.
    Ymd,
    /// Year, month.
    Ym,
    /// Month, year.
    My,
    /// Month, day.
    Md,
}

/// What kind of text a text is (SABLE's SAYAS).
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SayAs {
    /// Letters to be spelt.
    Literal,
    /// A date.
    Date(Option<Order>),
    /// A time of day.
    Time,
    /// A telephone number.
    Phone,
    /// An address on the net.
    Net {
        /// Of electronic mail rather than of a page.
        email: bool,
    },
    /// A postal address.
    Postal,
    /// An amount of money.
    Currency,
    /// A formula.
    Math,
    /// A fraction.
    Fraction,
    /// A quantity with its unit.
    Measure,
    /// A rank.
    Ordinal,
    /// A count.
    Cardinal,
    /// A name.
    Name,
}
