//! The fold sequence: its order, its checker, its closure, and the animation.

mod common;

use flexframe::assembly::fold::{Broken, FoldSequence, Member, Task};
use flexframe::params::Frame;
use flexframe::skeleton::{Skeleton, placements};

fn preset(name: &str) -> (Frame, Skeleton) {
    let frame = Frame::load(name).expect("a preset").0;
    let skeleton = Skeleton::new(&frame).expect("closes");
    (frame, skeleton)
}

#[test]
fn analytic_the_found_order_breaks_nothing() {
    let (frame, skeleton) = preset("cognifly-v8");
    let fold = FoldSequence::new(&frame, &skeleton).expect("can be folded");
    println!("{:#?}", fold.steps.iter().map(|s| (s.task, &s.after, &s.before, s.loop_error_mm)).collect::<Vec<_>>());
    assert_eq!(fold.rules(&frame, &skeleton).check(&fold.order()), []);
}
