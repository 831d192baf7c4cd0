//! What the source tree promises: the order of its imports, no circles of files, licences of the libraries.

mod circles;
mod layering;
mod licences;
