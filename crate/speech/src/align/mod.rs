//! Times of words and phones that other programs wrote.
