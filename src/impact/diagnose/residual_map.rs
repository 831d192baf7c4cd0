//! The residual of a model's mean waves by height and part of the impact.

use serde::Serialize;

use super::gap::errors;
use crate::impact::effects::Model;
use crate::impact::fit::{BEFORE, FitProblem, Waves};
use crate::impact::sim::{SolverOptions, System, Trace, simulate};

/// A part of an impact.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Phase {
    /// The first 1.5 ms.
    FirstTouch,
    /// Until near the largest compression.
    Loading,
    /// One millisecond before and behind the largest compression.
    Peak,
    /// From there until the ground ceases to push.
    Unloading,
    /// After that.
    Flight,
}

impl Phase {
    /// For people.
    pub fn words(self) -> &'static str {
        match self {
            Self::FirstTouch => "first touch",
            Self::Loading => "loading",
            Self::Peak => "peak",
            Self::Unloading => "unloading",
            Self::Flight => "flight",
        }
    }
}

/// One sample of one height.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Point {
    /// Height, m.
    pub height_m: f64,
    /// Part of the impact.
    pub phase: Phase,
    /// Time from first touch in the model, ms: the middle of the step that the sample stands for.
    pub t_ms: f64,
    /// Compression in the model, mm.
    pub x_mm: f64,
    /// Its rate in the model, m/s.
    pub v_m_s: f64,
    /// Mean of the readings, g.
    pub measured_g: f64,
    /// Predicted mean, g.
    pub model_g: f64,
    /// Standard error of the mean, g.
    pub error_g: f64,
}

/// The residual of one height and phase.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Cell {
    /// Height, m.
    pub height_m: f64,
    /// Part of the impact.
    pub phase: Phase,
    /// Root mean square of measured less model, g.
    pub residual_g: f64,
    /// The same of the standard error, g.
    pub error_g: f64,
}

/// The residual by height and phase.
#[derive(Clone, Debug, Serialize)]
pub struct ResidualMap {
    /// By height and phase.
    pub cells: Vec<Cell>,
    /// The sample with the largest residual in units of its standard error.
    pub worst: Point,
    /// Mean cosine between the residuals of neighbouring heights as functions of time, of displacement while
    /// loading, and of speed while loading; the largest says on which of them the missing effect depends.
    pub same_in: SameIn,
}

/// Cosine between the residuals of different heights: 1 where one is a positive multiple of the other. No means are taken off, as a residual that is the
/// same at all heights is alike in full.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct SameIn {
    /// By time.
    pub t: f64,
    /// By displacement.
    pub x: f64,
    /// By speed.
    pub v: f64,
}

const FIRST_S: f64 = 1.5e-3;
const NEAR_PEAK_S: f64 = 1e-3;
/// Places at which shapes are compared.
const GRID: usize = 24;

/// Every sample of every height with the model's state there.
pub fn points(problem: &FitProblem, waves: &Waves, model: &Model) -> Option<Vec<Point>> {
    let (system, ready) = (System::new(model), problem.expected.system(model));
    let mut all = Vec::new();
    for group in &waves.groups {
        let trace = simulate(&system, group.height_m, &SolverOptions::FIT);
        let predicted = problem.expected.window(&ready, group.height_m)?;
        let onset_s = problem.expected.onset_s(&ready, group.height_m)?;
        let errors = errors(group);
        for i in 0..waves.samples {
            let t_s = onset_s + waves.step_s * (i as f64 + 0.5 - BEFORE as f64);
            let at = ((t_s / Trace::STEP_S).max(0.0) as usize).min(trace.x_m.len().saturating_sub(1));
            all.push(Point {
                height_m: group.height_m,
                phase: phase(&trace, t_s),
                t_ms: t_s * 1e3,
                x_mm: if t_s < 0.0 { 0.0 } else { trace.x_m[at] * 1e3 },
                v_m_s: if t_s < 0.0 { trace.impact_speed_m_s } else { trace.v_m_s[at] },
                measured_g: group.mean[i],
                model_g: predicted[i],
                error_g: errors[i],
            });
        }
    }
    Some(all)
}

fn phase(trace: &Trace, t_s: f64) -> Phase {
    let turn = trace.v_m_s.iter().position(|v| *v <= 0.0).unwrap_or(trace.v_m_s.len()) as f64 * Trace::STEP_S;
    match t_s {
        _ if t_s < FIRST_S => Phase::FirstTouch,
        _ if t_s < turn - NEAR_PEAK_S => Phase::Loading,
        _ if t_s < turn + NEAR_PEAK_S => Phase::Peak,
        _ if t_s < trace.contact_s.unwrap_or(f64::INFINITY) => Phase::Unloading,
        _ => Phase::Flight,
    }
}

/// Sums points up; `None` when there is none.
pub fn residual_map(points: &[Point]) -> Option<ResidualMap> {
    let mut heights: Vec<f64> = points.iter().map(|point| point.height_m).collect();
    heights.dedup();
    let mut cells = Vec::new();
    for height_m in &heights {
        for phase in [Phase::FirstTouch, Phase::Loading, Phase::Peak, Phase::Unloading, Phase::Flight] {
            let inside: Vec<&Point> = points.iter().filter(|point| point.height_m == *height_m && point.phase == phase).collect();
            if !inside.is_empty() {
                let root = |of: &dyn Fn(&Point) -> f64| {
                    (inside.iter().map(|point| of(point) * of(point)).sum::<f64>() / inside.len() as f64).sqrt()
                };
                let (residual_g, error_g) = (root(&|point| point.measured_g - point.model_g), root(&|point| point.error_g));
                cells.push(Cell { height_m: *height_m, phase, residual_g, error_g });
            }
        }
    }
    let far = |point: &Point| (point.measured_g - point.model_g).abs() / point.error_g.max(1e-3);
    let worst = *points.iter().max_by(|a, b| far(a).total_cmp(&far(b)))?;
    let loading = |point: &&Point| matches!(point.phase, Phase::FirstTouch | Phase::Loading | Phase::Peak) && point.t_ms > 0.0;
    let shape = |of: &dyn Fn(&Point) -> f64, all: bool| {
        let series: Vec<Vec<(f64, f64)>> = heights
            .iter()
            .map(|height_m| {
                points
                    .iter()
                    .filter(|point| point.height_m == *height_m && (all || loading(point)))
                    .map(|point| (of(point), point.measured_g - point.model_g))
                    .collect()
            })
            .collect();
        alike(&series)
    };
    let same_in =
        SameIn { t: shape(&|point| point.t_ms, true), x: shape(&|point| point.x_mm, false), v: shape(&|point| -point.v_m_s, false) };
    Some(ResidualMap { cells, worst, same_in })
}

/// Mean cosine of neighbouring heights over the range that both have.
fn alike(series: &[Vec<(f64, f64)>]) -> f64 {
    let mut sum = 0.0;
    let mut count = 0.0;
    for pair in series.windows(2) {
        let (a, b) = (ordered(&pair[0]), ordered(&pair[1]));
        let (Some(first_a), Some(first_b), Some(last_a), Some(last_b)) = (a.first(), b.first(), a.last(), b.last()) else { continue };
        let (low, high) = (first_a.0.max(first_b.0), last_a.0.min(last_b.0));
        if high <= low {
            continue;
        }
        let grid = |i: usize| low + (high - low) * i as f64 / (GRID - 1) as f64;
        let (left, right): (Vec<f64>, Vec<f64>) = (0..GRID).map(|i| (between(&a, grid(i)), between(&b, grid(i)))).unzip();
        sum += cosine(&left, &right);
        count += 1.0;
    }
    if count > 0.0 { sum / count } else { 0.0 }
}

fn ordered(series: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let mut ordered = series.to_vec();
    ordered.sort_by(|a, b| a.0.total_cmp(&b.0));
    ordered
}

fn between(series: &[(f64, f64)], at: f64) -> f64 {
    let right = series.partition_point(|point| point.0 < at).clamp(1, series.len().max(2) - 1);
    let (Some(a), Some(b)) = (series.get(right - 1), series.get(right)) else { return series.first().map_or(0.0, |point| point.1) };
    if b.0 > a.0 { a.1 + (b.1 - a.1) * ((at - a.0) / (b.0 - a.0)).clamp(0.0, 1.0) } else { a.1 }
}

fn cosine(a: &[f64], b: &[f64]) -> f64 {
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    product(a, b) / (product(a, a) * product(b, b)).sqrt().max(1e-300)
}
