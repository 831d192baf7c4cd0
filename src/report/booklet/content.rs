//! The instructions as a value: title page, one page a step. Two files are written from it.

use crate::export::bom;
use crate::frame::assembly::Design;
use crate::frame::assembly::mass::MassTable;
use crate::frame::fold::{FoldBend, FoldSequence, Step};
use crate::report::picture::fold_scene;
use crate::report::picture::fold_scene::Picture;
use rayon::prelude::*;

/// Instructions to be printed.
pub struct Booklet {
    /// The frame's name.
    pub frame: String,
    /// What to know before the first step.
    pub preface: Vec<String>,
    /// The frame taken apart.
    pub apart: Picture,
    /// How many, what, of what.
    pub parts: Vec<[String; 3]>,
    /// A line a stock length: what to cut from it.
    pub cuts: Vec<String>,
    /// The steps.
    pub pages: Vec<Page>,
}

/// A step on paper.
pub struct Page {
    /// Number and title.
    pub heading: String,
    /// How often, how long, with what.
    pub facts: String,
    /// What to do.
    pub text: String,
    /// Angles, ways and what holds them.
    pub measures: Vec<String>,
    /// What to take care of.
    pub caution: Option<String>,
    /// Before, with arrows, and after.
    pub pictures: [Picture; 2],
}

impl Booklet {
    /// The instructions of a frame.
    pub fn new(design: &Design, masses: &MassTable, fold: &FoldSequence) -> Self {
        let minutes: f64 = fold.steps.iter().map(|step| step.minutes).sum();
        let pages = fold.steps.par_iter().enumerate().map(|(at, step)| Page::new(design, fold, step, at)).collect();
        let preface = vec![
            format!(
                "{} steps, about {minutes:.0} minutes. Print the parts flat, as they lie in their files; cut the rods; lay everything out.",
                fold.steps.len()
            ),
            "Carbon dust harms lungs, eyes and skin: cut the rods wet, under a mask, with glasses and gloves, and wipe them before use."
                .into(),
            "Glue belongs only on a rod that is loose in its bore. Never glue a hinge, nor the plugs in the hub: they let go in a crash."
                .into(),
            "In the pictures what moves is dark, what it is joined to is less dark, and the rest is pale. They show one module; \
             a step that says 4 x is done at each of the four. What sits on the hub is mounted before."
                .into(),
        ];
        Self {
            frame: design.frame.name.clone(),
            preface,
            apart: fold_scene::apart(design, fold),
            parts: parts(masses),
            cuts: cuts(design),
            pages,
        }
    }
}

fn parts(masses: &MassTable) -> Vec<[String; 3]> {
    let row = |name: &str| name.replace('_', " ");
    masses.lines.iter().map(|line| [format!("{} x", line.quantity), row(&line.name), row(&line.material)]).collect()
}

fn cuts(design: &Design) -> Vec<String> {
    let stock_mm = design.frame.bought.get("rod").map_or(1000.0, |rod| rod.part.stock_length_mm.unwrap_or(rod.part.size_mm[0]));
    match bom::cutting_plan(design, stock_mm) {
        Ok(plan) => plan
            .iter()
            .enumerate()
            .map(|(index, stock)| {
                let pieces: Vec<String> = stock.pieces.iter().map(|(role, mm)| format!("{} {mm:.1}", role.slug())).collect();
                format!("{}. of {stock_mm:.0} mm: {}; rest {:.1}", index + 1, pieces.join(", "), stock.rest_mm)
            })
            .collect(),
        Err(error) => vec![error.to_string()],
    }
}

impl Page {
    fn new(design: &Design, fold: &FoldSequence, step: &Step, at: usize) -> Self {
        let each = step.minutes / step.repeats as f64;
        let often = if step.repeats == 1 { "once".into() } else { format!("{} x", step.repeats) };
        let mut measures: Vec<String> = step.bends.iter().map(bend).collect();
        measures.extend(left_out(step));
        Self {
            heading: format!("{}. {}", step.number, step.title),
            facts: format!("{often}, {each:.0} min each; {}", step.tool),
            text: step.text.into(),
            measures,
            caution: step.caution.map(Into::into),
            pictures: fold_scene::step(design, fold, at),
        }
    }
}

fn bend(bend: &FoldBend) -> String {
    let part = bend.body.trim_end_matches("_FR").replace('_', " ");
    let moment = bend.load.moment_n_mm.map_or(String::new(), |moment| format!(", held by some {moment:.0} N mm"));
    let preload =
        if bend.preload_deg > 0.0 { format!("; its notch is closed at {:.0}°", bend.to_deg - bend.preload_deg) } else { String::new() };
    format!("{part}, {}: from {:.0}° to {:.0}°{preload}{moment}.", bend.hinge, bend.from_deg, bend.to_deg)
}

/// What stays open until the triangle is closed, once for both of two rods.
fn left_out(step: &Step) -> Option<String> {
    let join = step.joins.iter().find(|join| join.left_out_mm > 0.05)?;
    Some(format!("Leave {:.1} mm open: they are closed when the foot is bent.", join.left_out_mm))
}
