//! The frame as a structure: parts as beams, rods, ties between them, a rigid centre, masses, feet.

use crate::frame::skeleton::RodRole;
use crate::mechanics::system::equation_system::System;

/// How much of the frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// All four modules; the centre moves freely.
    Whole,
    /// The first module, between two planes of symmetry; the centre moves up and down. A quarter of force, mass and energy.
    Quarter,
}

impl Extent {
    /// How many of it make a frame.
    pub fn copies(self) -> f64 {
        match self {
            Self::Whole => 1.0,
            Self::Quarter => 4.0,
        }
    }
}

/// Zone of what is as good as rigid and joins a part's nodes: it has no energy or strain of its own to tell.
pub const LINKS: &str = "links";

/// What a beam or tie is.
#[derive(Clone, Debug)]
pub struct Tag {
    /// Its zone: a part's, a rod's role, `plugs and sockets`.
    pub zone: &'static str,
    /// Farthest fibres, mm; zero for ties.
    pub reach_mm: [f64; 2],
    /// E A, E I about y and z; zero for ties.
    pub rigidity: [f64; 3],
    /// Whether it is of the flexible material.
    pub flexible: bool,
}

/// A rod in the model.
#[derive(Clone, Debug)]
pub struct RodLine {
    /// Its name.
    pub name: String,
    /// Its role.
    pub role: RodRole,
    /// Its beams.
    pub beams: Vec<usize>,
    /// Length that may buckle, mm: between its hinges, or its sockets' mouths where these do not fold.
    pub free_mm: f64,
    /// E I, N mm².
    pub bending_n_mm2: f64,
}

/// A body and the nodes that carry it.
#[derive(Clone, Debug)]
pub struct Skin {
    /// Index among the design's bodies.
    pub body: usize,
    /// Nodes of the structure.
    pub nodes: Vec<usize>,
}

/// The frame, ready to be solved.
pub struct FrameModel {
    /// The structure.
    pub system: System,
    /// What its beams, then its ties, are.
    pub tags: Vec<Tag>,
    /// The node of the rigid centre.
    pub hub: usize,
    /// Rods.
    pub rods: Vec<RodLine>,
    /// Nodes at the motors' centres.
    pub motors: Vec<usize>,
    /// Bodies and what carries them; bodies of the centre are carried by `hub`.
    pub skins: Vec<Skin>,
    /// How much of the frame it is.
    pub extent: Extent,
    /// By how much its links are stiffer than those of soft joints, and what rounding leaves of forces is larger.
    pub link_factor: f64,
}
