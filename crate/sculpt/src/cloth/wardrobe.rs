//! Garments of figures and their colours.

use serde::{Deserialize, Serialize};

/// Outfit of a figure; colours are linear RGB.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Outfit {
    /// A fine sweater with a soft high neck, trousers, leather shoes.
    Sweater(Sweater),
    /// A buttoned cardigan over a shirt, corduroy trousers, leather shoes.
    Cardigan(Cardigan),
    /// A hooded sweatshirt, jeans with rolled hems, sneakers.
    Hoodie(Hoodie),
}

/// Colours from the waist down.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Legs {
    /// Trousers.
    pub trousers: [f64; 3],
    /// Uppers of the shoes.
    pub shoe: [f64; 3],
    /// Soles.
    pub sole: [f64; 3],
    /// Socks.
    pub sock: [f64; 3],
}

/// Colours of [`Outfit::Sweater`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sweater {
    /// Sweater.
    pub knit: [f64; 3],
    /// Trousers and shoes.
    pub legs: Legs,
}

/// Colours of [`Outfit::Cardigan`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cardigan {
    /// Cardigan.
    pub knit: [f64; 3],
    /// Shirt.
    pub shirt: [f64; 3],
    /// Buttons of the cardigan.
    pub button: [f64; 3],
    /// Corduroy trousers and leather shoes.
    pub legs: Legs,
}

/// Colours of [`Outfit::Hoodie`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Hoodie {
    /// Sweatshirt and hood.
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
