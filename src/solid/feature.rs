//! The feature tree: what a part is, before any kernel sees it.

use nalgebra::{Isometry3, Point3, Rotation3, Translation3, UnitQuaternion, Vector3};

use super::profile::{Contour, Profile};
use crate::units::Angle;

/// A solid as a small tree of features, mm.
#[derive(Clone, Debug, PartialEq)]
pub enum Feature {
    /// The profile in the xy plane, drawn up along z from 0 to the height.
    Extrude {
        /// Outline in x, y.
        profile: Profile,
        /// Height along z, mm.
        height_mm: f64,
    },
    /// A cylinder along z from 0 to its height.
    Cylinder {
        /// Radius, mm.
        radius_mm: f64,
        /// Height, mm.
        height_mm: f64,
    },
    /// A cylinder along z from 0 to its height that something passes through: its polygon is drawn around the circle.
    Bore {
        /// Radius of the circle that must stay free, mm.
        radius_mm: f64,
        /// Height, mm.
        height_mm: f64,
    },
    /// A frustum along z.
    Cone {
        /// Radius at z = 0, mm.
        bottom_radius_mm: f64,
        /// Radius at the height, mm.
        top_radius_mm: f64,
        /// Height, mm.
        height_mm: f64,
    },
    /// A sphere around the origin.
    Sphere {
        /// Radius, mm.
        radius_mm: f64,
    },
    /// The profile in (r, z), r >= 0, turned once about z.
    Revolve {
        /// Outline in r, z.
        profile: Profile,
        /// Where the polygon that stands for the circle has corners, from x towards y: where another surface touches this one. None: even
        /// steps from x.
        corners: Vec<Angle>,
    },
    /// The convex hull of all.
    Hull(Vec<Feature>),
    /// All together.
    Union(Vec<Feature>),
    /// The base without the cuts.
    Difference {
        /// What is cut.
        base: Box<Feature>,
        /// What is taken away.
        cuts: Vec<Feature>,
    },
    /// What all share.
    Intersection(Vec<Feature>),
    /// A feature moved rigidly.
    Placed {
        /// From the feature's axes to those of the tree.
        pose: Isometry3<f64>,
        /// What is moved.
        of: Box<Feature>,
    },
    /// A feature mirrored at a plane through the origin.
    Mirrored {
        /// Normal of the plane.
        normal: Vector3<f64>,
        /// What is mirrored.
        of: Box<Feature>,
    },
}

impl Feature {
    /// A cylinder along z from 0.
    pub fn cylinder(radius_mm: f64, height_mm: f64) -> Self {
        Self::Cylinder { radius_mm, height_mm }
    }

    /// A bore along z from 0.
    pub fn bore(radius_mm: f64, height_mm: f64) -> Self {
        Self::Bore { radius_mm, height_mm }
    }

    /// A cylinder from one point to another.
    pub fn cylinder_between(from: Point3<f64>, to: Point3<f64>, radius_mm: f64) -> Self {
        Self::cylinder(radius_mm, (to - from).norm()).along(from, to)
    }

    /// A bore from one point to another.
    pub fn bore_between(from: Point3<f64>, to: Point3<f64>, radius_mm: f64) -> Self {
        Self::bore(radius_mm, (to - from).norm()).along(from, to)
    }

    /// A frustum along z from 0.
    pub fn cone(bottom_radius_mm: f64, top_radius_mm: f64, height_mm: f64) -> Self {
        Self::Cone { bottom_radius_mm, top_radius_mm, height_mm }
    }

    /// A sphere around the origin.
    pub fn sphere(radius_mm: f64) -> Self {
        Self::Sphere { radius_mm }
    }

    /// A profile drawn up along z.
    pub fn extrude(profile: Profile, height_mm: f64) -> Self {
        Self::Extrude { profile, height_mm }
    }

    /// A profile in (r, z) turned once about z.
    pub fn revolve(profile: Profile) -> Self {
        Self::revolve_with_corners(profile, [])
    }

    /// The same with corners of its polygon where another surface touches it, as angles from x towards y.
    pub fn revolve_with_corners(profile: Profile, corners: impl IntoIterator<Item = Angle>) -> Self {
        Self::Revolve { profile, corners: corners.into_iter().collect() }
    }

    /// An axis-parallel box around the origin, by its edge lengths.
    pub fn cuboid(size: [f64; 3]) -> Self {
        Self::extrude(Profile::new(Contour::rectangle([0.0, 0.0], [size[0], size[1]])), size[2]).at(0.0, 0.0, -0.5 * size[2])
    }

    /// An axis-parallel box between two corners.
    pub fn cuboid_between(low: [f64; 3], high: [f64; 3]) -> Self {
        let size = [high[0] - low[0], high[1] - low[1], high[2] - low[2]];
        Self::cuboid(size).at(0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]), 0.5 * (low[2] + high[2]))
    }

    /// The convex hull of all.
    pub fn hull(of: impl IntoIterator<Item = Feature>) -> Self {
        Self::Hull(of.into_iter().collect())
    }

    /// All together.
    pub fn union(of: impl IntoIterator<Item = Feature>) -> Self {
        Self::Union(of.into_iter().collect())
    }

    /// What all share.
    pub fn intersection(of: impl IntoIterator<Item = Feature>) -> Self {
        Self::Intersection(of.into_iter().collect())
    }

    /// This without the cuts.
    pub fn minus(self, cuts: impl IntoIterator<Item = Feature>) -> Self {
        Self::Difference { base: Box::new(self), cuts: cuts.into_iter().collect() }
    }

    /// Moved by x, y, z in mm.
    pub fn at(self, x: f64, y: f64, z: f64) -> Self {
        self.placed(Isometry3::from_parts(Translation3::new(x, y, z), UnitQuaternion::identity()))
    }

    /// Turned about the x axis.
    pub fn turned_x(self, angle: Angle) -> Self {
        self.turned(Vector3::x(), angle)
    }

    /// Turned about the y axis.
    pub fn turned_y(self, angle: Angle) -> Self {
        self.turned(Vector3::y(), angle)
    }

    /// Turned about the z axis.
    pub fn turned_z(self, angle: Angle) -> Self {
        self.turned(Vector3::z(), angle)
    }

    /// Turned about an axis through the origin.
    pub fn turned(self, axis: Vector3<f64>, angle: Angle) -> Self {
        let turn = UnitQuaternion::from_axis_angle(&nalgebra::Unit::new_normalize(axis), angle.to_rad());
        self.placed(Isometry3::from_parts(Translation3::identity(), turn))
    }

    /// The same with the radius of every round bore larger by some mm; nothing else changes.
    pub fn with_wider_bores(&self, by_mm: f64) -> Self {
        let all = |of: &[Self]| of.iter().map(|one| one.with_wider_bores(by_mm)).collect();
        let one = |of: &Self| Box::new(of.with_wider_bores(by_mm));
        match self {
            Self::Bore { radius_mm, height_mm } => Self::Bore { radius_mm: radius_mm + by_mm, height_mm: *height_mm },
            Self::Extrude { profile, height_mm } => Self::Extrude { profile: profile.with_wider_bores(by_mm), height_mm: *height_mm },
            Self::Hull(of) => Self::Hull(all(of)),
            Self::Union(of) => Self::Union(all(of)),
            Self::Intersection(of) => Self::Intersection(all(of)),
            Self::Difference { base, cuts } => Self::Difference { base: one(base), cuts: all(cuts) },
            Self::Placed { pose, of } => Self::Placed { pose: *pose, of: one(of) },
            Self::Mirrored { normal, of } => Self::Mirrored { normal: *normal, of: one(of) },
            Self::Cylinder { .. } | Self::Cone { .. } | Self::Sphere { .. } | Self::Revolve { .. } => self.clone(),
        }
    }

    /// Moved rigidly; nested moves become one.
    pub fn placed(self, pose: Isometry3<f64>) -> Self {
        match self {
            Self::Placed { pose: inner, of } => Self::Placed { pose: pose * inner, of },
            other => Self::Placed { pose, of: Box::new(other) },
        }
    }

    /// Mirrored at the plane through the origin with this normal.
    pub fn mirrored(self, normal: Vector3<f64>) -> Self {
        Self::Mirrored { normal, of: Box::new(self) }
    }

    /// A feature modelled along z laid from one point towards another.
    pub fn along(self, from: Point3<f64>, to: Point3<f64>) -> Self {
        let direction = (to - from).normalize();
        let turn = Rotation3::rotation_between(&Vector3::z(), &direction)
            .unwrap_or_else(|| Rotation3::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI));
        self.placed(Isometry3::from_parts(Translation3::from(from.coords), UnitQuaternion::from_rotation_matrix(&turn)))
    }
}
