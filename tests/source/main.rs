//! What the source tree promises: the order of its imports, licences of the libraries.

mod layering;
mod licences;
