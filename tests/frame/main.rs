//! The frame from its parameters: parts, kernels, fold, files, mechanics, against arithmetic and the real frame.

mod booklet;
mod common;
mod compensation;
mod drives;
mod export;
mod fold;
mod frames;
mod kernels;
mod live;
mod long_frames;
mod measured_overlap;
mod measured_parts;
mod measured_skeleton;
mod mechanics;
mod mounting;
mod numbers;
mod plates;
mod random_builds;
mod random_frames;
#[expect(dead_code, reason = "the example that writes docs/comparison.md uses the rest")]
mod real;
mod simulators;
mod sleeve_across;
mod step;
