//! What the source tree promises: the order of its imports, no circles of files, licences of the libraries, the same libraries in
//! the WebAssembly module.

mod circles;
mod engine_lock;
mod layering;
mod licences;
