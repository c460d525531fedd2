//! Garments of figures and their colours.

use serde::{Deserialize, Serialize};

/// Outfit of a figure: the garments and their colours, linear RGB.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Outfit {
    /// A fine sweater with a soft high neck, trousers, leather shoes.
    Sweater(Sweater),
    /// A buttoned cardigan over a shirt, corduroy trousers, leather shoes.
    Cardigan(Cardigan),
    /// A hooded sweatshirt, jeans with rolled hems, sneakers.
    Hoodie(Hoodie),
}

/// Colours of the garments from the waist down: trousers, shoes and socks; linear RGB.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Legs {
    /// Colour of the trousers, linear RGB.
    pub trousers: [f64; 3],
    /// Uppers of the shoes.
    pub shoe: [f64; 3],
    /// Colour of the soles, linear RGB.
    pub sole: [f64; 3],
    /// Colour of the socks, linear RGB.
    pub sock: [f64; 3],
}

/// Colours of the garments of [`Outfit::Sweater`], linear RGB.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sweater {
    /// Colour of the sweater, linear RGB.
    pub knit: [f64; 3],
    /// Colours of the trousers and the shoes.
    pub legs: Legs,
}

/// Colours of the garments of [`Outfit::Cardigan`], linear RGB.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cardigan {
    /// Colour of the cardigan, linear RGB.
    pub knit: [f64; 3],
    /// Colour of the shirt, linear RGB.
    pub shirt: [f64; 3],
    /// Buttons of the cardigan.
    pub button: [f64; 3],
    /// Corduroy trousers and leather shoes.
    pub legs: Legs,
}

/// Colours of the garments of [`Outfit::Hoodie`], linear RGB.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Hoodie {
    /// Colour of the sweatshirt and its hood, linear RGB.
    pub fleece: [f64; 3],
    /// T-shirt at the neck.
    pub shirt: [f64; 3],
    /// Cords of the hood.
    pub cord: [f64; 3],
    /// Jeans and the canvas of the sneakers.
    pub legs: Legs,
    /// Laces of the sneakers.
    pub lace: [f64; 3],
}
