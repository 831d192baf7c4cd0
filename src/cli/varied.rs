//! Keys that vary in a search, as they are typed for `solve` and `new`.

use super::failure::Failure;
use super::session;
use crate::params::Frame;
use crate::variant::Vary;

/// How far a parameter without bounds of its own may vary, in shares of its value.
const REACH: f64 = 0.2;

/// What varies, by the texts of `--vary`.
pub(super) fn varied(texts: &[String], frame: &Frame) -> Result<Vec<Vary>, Failure> {
    let all = texts.iter().map(|text| vary(text, frame)).collect::<Result<Vec<_>, _>>()?;
    match all.iter().enumerate().find(|(at, v)| all[..*at].iter().any(|other| other.key() == v.key())) {
        Some((_, twice)) => Err(Failure::Usage { message: format!("--vary: {} stands there twice", twice.key()) }),
        None => Ok(all),
    }
}

/// A parameter that varies: `arm_rod` or `arm_rod=70..90`.
fn vary(text: &str, frame: &Frame) -> Result<Vary, Failure> {
    let (key, range) = text.split_once('=').map_or((text, None), |(key, range)| (key, Some(range)));
    let parameter = session::parameter(key.trim())?;
    if parameter.table == "limits" {
        let message = format!("--vary {}: a limit is what the search keeps; change it in the frame file, and solve that", parameter.key);
        return Err(Failure::Usage { message });
    }
    let bounds = [parameter.min, parameter.max];
    if let Some(range) = range {
        let wrong =
            || Failure::Usage { message: format!("--vary {text}: give bounds as {key}=LEAST..MOST within {} to {}", bounds[0], bounds[1]) };
        let (least, most) = range.split_once("..").ok_or_else(wrong)?;
        let number = |text: &str| text.trim().parse::<f64>().ok().filter(|value| (bounds[0]..=bounds[1]).contains(value));
        let stated = [number(least).ok_or_else(wrong)?, number(most).ok_or_else(wrong)?];
        if stated[0] > stated[1] {
            return Err(wrong());
        }
        return Ok(Vary { parameter, bounds: stated });
    }
    Ok(Vary::around(parameter, frame, REACH))
}
