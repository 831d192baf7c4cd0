//! Rules of printing: each part on its printer's bed, layer by layer.

pub(in crate::checks) mod bed;
pub(in crate::checks) mod bridge;
pub(in crate::checks) mod footing;
pub(in crate::checks) mod gap;
pub(in crate::checks) mod heat;
pub(in crate::checks) mod hung;
pub(in crate::checks) mod island;
pub(in crate::checks) mod layer_direction;
pub(in crate::checks) mod overhang;
pub(in crate::checks) mod wall;
