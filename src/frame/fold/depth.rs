//! How deep a rod's end is in a bore when it is at the bottom: where a person marks the rod.

use super::member::Member;
use crate::frame::skeleton::Skeleton;

/// A rod's end in a bore.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Depth {
    /// From the rod's end to the bore's mouth, mm.
    pub mm: f64,
    /// From the rod's start to the bore's mouth, mm.
    pub along_mm: f64,
}

/// How deep the first module's rod is in a part of a module, if it is.
pub fn depth(skeleton: &Skeleton, rod: Member, (part, module): (Member, usize)) -> Option<Depth> {
    let rod = skeleton.rods.iter().find(|r| r.name == rod.body(0))?;
    let ends = [(rod.start, 0.0), (rod.end, rod.length_mm())];
    let (socket, (end, at)) = rod.sockets.iter().zip(ends).find(|(s, _)| s.module == module && part.part() == Some(s.part))?;
    let mm = socket.depth_mm - socket.axis.dot(&(end - socket.bottom));
    Some(Depth { mm, along_mm: (at - mm).abs() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::Frame;

    #[test]
    fn analytic_a_mark_is_as_far_from_the_end_as_the_bore_is_deep() {
        let frame = Frame::load("cognifly").expect("a preset").0;
        let skeleton = Skeleton::new(&frame).expect("closes");
        let of = |rod, part, module| depth(&skeleton, rod, (part, module)).expect("is in it");
        let corner = frame.corner.corner_socket_depth_mm;
        let [own, next] = [of(Member::Cage(true), Member::Corner(true), 0), of(Member::Cage(true), Member::Corner(true), 1)];
        assert!((own.mm - corner).abs() < 1e-6 && (next.mm - corner).abs() < 1e-6, "{own:?} {next:?}");
        assert!((own.along_mm - next.along_mm).abs() > frame.rods.cage_rod_length_mm - 2.0 * corner - 1e-6);
        assert_eq!(depth(&skeleton, Member::Cage(true), (Member::Corner(true), 2)), None);
        assert_eq!(depth(&skeleton, Member::Hub, (Member::Corner(true), 0)), None);
    }
}
