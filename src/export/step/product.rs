//! Products, colours and places (ISO 10303-41, -43, -44, -46).

use nalgebra::{Isometry3, Point3, Vector3};

use super::shape;
use super::shaped::Shaped;
use super::writer::{Decimal, Id, Writer, length, list, string};
use crate::export::colour::curved;
use crate::figures::to_thousandth;
use crate::solid::FLATNESS_MM;

/// How far vertices may lie beside the surfaces of their faces, mm, as every file states: two that are off to either side.
const ACCURACY_MM: f64 = 2.0 * FLATNESS_MM;

/// What all products of a file share.
pub(super) struct Context {
    product: Id,
    definition: Id,
    /// Units and accuracy of all geometry.
    geometry: Id,
}

/// A product with its shape.
pub(super) struct Product {
    definition: Id,
    representation: Id,
    /// Origin of the product's axes, an item of its representation.
    origin: Id,
}

impl Context {
    pub(super) fn new(writer: &mut Writer) -> Self {
        let application = writer.add("APPLICATION_CONTEXT('core data for automotive mechanical design processes')");
        writer.add(format_args!("APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2000,{application})"));
        let product = writer.add(format_args!("PRODUCT_CONTEXT('',{application},'mechanical')"));
        let definition = writer.add(format_args!("PRODUCT_DEFINITION_CONTEXT('part definition',{application},'design')"));
        let length = writer.add("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))");
        let angle = writer.add("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))");
        let solid_angle = writer.add("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())");
        let accuracy = writer.add(format_args!(
            "UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE({}),{length},'distance_accuracy_value','vertices beside their surfaces')",
            super::writer::length(ACCURACY_MM),
        ));
        let geometry = writer.add(format_args!(
            "(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT(({accuracy}))\
             GLOBAL_UNIT_ASSIGNED_CONTEXT(({length},{angle},{solid_angle}))REPRESENTATION_CONTEXT('','3D'))"
        ));
        Self { product, definition, geometry }
    }

    /// A part by its solids, coloured.
    pub(super) fn part(&self, writer: &mut Writer, part: &Shaped) -> Product {
        let origin = origin(writer);
        let mut items = vec![origin];
        for solid in shape::solids(writer, &part.name, &part.boundary) {
            self.coloured(writer, solid, part.colour);
            items.push(solid);
        }
        let items = list(&items);
        let name = string(&part.name);
        let representation = writer.add(format_args!("ADVANCED_BREP_SHAPE_REPRESENTATION({name},{items},{})", self.geometry));
        self.product(writer, &part.name, &part.material, origin, representation)
    }

    /// Parts in their places, by the index of the part.
    pub(super) fn assembly(&self, writer: &mut Writer, name: &str, parts: &[Product], bodies: &[(String, usize, Isometry3<f64>)]) {
        let origin = origin(writer);
        let places: Vec<Id> = bodies.iter().map(|(_, _, pose)| place(writer, pose)).collect();
        let items: Vec<Id> = std::iter::once(origin).chain(places.iter().copied()).collect();
        let representation = writer.add(format_args!("SHAPE_REPRESENTATION({},{},{})", string(name), list(&items), self.geometry));
        let frame = self.product(writer, name, "assembly", origin, representation);
        for ((name, part, _), place) in bodies.iter().zip(places) {
            let (part, name) = (&parts[*part], string(name));
            let (whole, each) = (frame.definition, part.definition);
            let usage = writer.add(format_args!("NEXT_ASSEMBLY_USAGE_OCCURRENCE({name},{name},'',{whole},{each},$)"));
            let shape = writer.add(format_args!("PRODUCT_DEFINITION_SHAPE('Placement',$,{usage})"));
            let moved = writer.add(format_args!("ITEM_DEFINED_TRANSFORMATION('','',{},{place})", part.origin));
            let relation = writer.add(format_args!(
                "(REPRESENTATION_RELATIONSHIP('','',{},{})REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION({moved})\
                 SHAPE_REPRESENTATION_RELATIONSHIP())",
                part.representation, frame.representation
            ));
            writer.add(format_args!("CONTEXT_DEPENDENT_SHAPE_REPRESENTATION({relation},{shape})"));
        }
    }

    fn product(&self, writer: &mut Writer, name: &str, description: &str, origin: Id, representation: Id) -> Product {
        let (name, description) = (string(name), string(description));
        let product = writer.add(format_args!("PRODUCT({name},{name},{description},({}))", self.product));
        let formation = writer.add(format_args!("PRODUCT_DEFINITION_FORMATION('','',{product})"));
        let definition = writer.add(format_args!("PRODUCT_DEFINITION('design','',{formation},{})", self.definition));
        let shape = writer.add(format_args!("PRODUCT_DEFINITION_SHAPE('',$,{definition})"));
        writer.add(format_args!("SHAPE_DEFINITION_REPRESENTATION({shape},{representation})"));
        writer.add(format_args!("PRODUCT_RELATED_PRODUCT_CATEGORY('part',$,({product}))"));
        Product { definition, representation, origin }
    }

    /// Gives a solid its colour: linear red, green, blue, alpha.
    fn coloured(&self, writer: &mut Writer, solid: Id, linear: [f32; 4]) {
        let [r, g, b] = [0, 1, 2].map(|channel| share(curved(linear[channel])));
        let colour = writer.add(format_args!("COLOUR_RGB('',{r},{g},{b})"));
        let fill = writer.add(format_args!("FILL_AREA_STYLE_COLOUR('',{colour})"));
        let fill = writer.add(format_args!("FILL_AREA_STYLE('',({fill}))"));
        let mut styles = vec![writer.add(format_args!("SURFACE_STYLE_FILL_AREA({fill})"))];
        if linear[3] < 1.0 {
            let clear = share(1.0 - f64::from(linear[3]));
            let clear = writer.add(format_args!("SURFACE_STYLE_TRANSPARENT({clear})"));
            styles.push(writer.add(format_args!("SURFACE_STYLE_RENDERING_WITH_PROPERTIES(.NORMAL_SHADING.,{colour},({clear}))")));
        }
        let side = writer.add(format_args!("SURFACE_SIDE_STYLE('',{})", list(&styles)));
        let usage = writer.add(format_args!("SURFACE_STYLE_USAGE(.BOTH.,{side})"));
        let style = writer.add(format_args!("PRESENTATION_STYLE_ASSIGNMENT(({usage}))"));
        let item = writer.add(format_args!("STYLED_ITEM('colour',({style}),{solid})"));
        writer.add(format_args!("MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION('',({item}),{})", self.geometry));
    }
}

/// A share of one, to a thousandth.
fn share(value: f64) -> Decimal {
    length(to_thousandth(value))
}

fn origin(writer: &mut Writer) -> Id {
    writer.placement(&Point3::origin(), &Vector3::z(), &Vector3::x())
}

fn place(writer: &mut Writer, pose: &Isometry3<f64>) -> Id {
    writer.placement(&pose.translation.vector.into(), &(pose * Vector3::z()), &(pose * Vector3::x()))
}
