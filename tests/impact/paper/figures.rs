//! What was published.

/// Heights of the model's figures, m.
pub const HEIGHTS_M: [f64; 8] = [0.3, 0.5, 1.0, 1.5, 2.62, 5.0, 10.0, 20.0];
/// Largest |x''| there, g.
pub const PEAKS_G: [f64; 8] = [46.2, 59.9, 85.2, 104.6, 138.5, 191.7, 271.5, 384.4];
/// Damper, spring, rigid collision there, % of m g h.
pub const SHARES: [[f64; 3]; 8] = [
    [72.2, 27.9, 0.0],
    [72.4, 27.6, 0.0],
    [72.6, 27.4, 0.0],
    [72.4, 25.4, 2.2],
    [63.8, 14.6, 21.6],
    [50.9, 7.6, 41.4],
    [38.4, 3.8, 57.8],
    [28.3, 1.9, 69.8],
];

/// Folder, height in cm, drops, quartiles of the peak of all axes, median of the peak along the axis, impulses over v0.
pub struct Height {
    pub folder: &'static str,
    pub drops: usize,
    pub quartiles_g: [f64; 3],
    pub axial_g: f64,
    /// Of the magnitude and along the axis; not given for the rigid centre.
    pub impulses: Option<[f64; 2]>,
}

pub const MEASURED: [Height; 4] = [
    Height { folder: "rigid_030cm", drops: 89, quartiles_g: [136.5, 159.3, 183.3], axial_g: 105.8, impulses: None },
    Height { folder: "soft_050cm", drops: 101, quartiles_g: [79.2, 89.7, 101.3], axial_g: 74.6, impulses: Some([2.22, 1.30]) },
    Height { folder: "soft_100cm", drops: 97, quartiles_g: [113.2, 127.4, 139.0], axial_g: 98.8, impulses: Some([2.15, 1.32]) },
    Height { folder: "soft_150cm", drops: 89, quartiles_g: [121.9, 136.7, 148.0], axial_g: 122.4, impulses: Some([1.95, 1.34]) },
];

/// Stiffness, N/m, and damping, N s/m.
pub const STIFFNESS_N_M: f64 = 7040.0;
pub const DAMPING_N_S_M: f64 = 46.0;
/// Their objective there, on all 287 drops of the soft frame.
pub const OBJECTIVE: f64 = 12.5599;
/// c with the filter at 2 pi 500 rad/s, and its interval.
pub const DAMPING_500_HZ: [f64; 3] = [23.2, 21.6, 25.1];
/// Rigid share at 1.5 m with it, %.
pub const RIGID_500_HZ: f64 = 29.8;

/// Dynamometer, N, and height of the frame, cm.
pub const STATIC_TEST: [[f64; 2]; 10] =
    [[0.0, 3.6], [20.0, 3.5], [33.0, 3.3], [41.0, 3.1], [55.0, 3.0], [70.0, 2.7], [81.0, 2.5], [90.0, 2.3], [100.0, 2.1], [115.0, 2.0]];
/// Weight of the frame, N, that the paper's line begins at.
pub const WEIGHT_N: f64 = 2.36;
/// k with that weight and its BIC; k and intercept of the free line and its BIC.
pub const STATIC_FITS: [f64; 5] = [7040.0, 39.8, 6375.0, 10.1, 36.0];
