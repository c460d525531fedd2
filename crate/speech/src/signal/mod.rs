//! The signal of speech: what is measured in it and how it is changed.
