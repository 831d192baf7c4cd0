//! Loops over numbers with the widest registers that a processor has.
//!
//! The program is compiled for every processor of its kind, so two numbers go into a register. Most processors have registers for four, which
//! [`with_wide_registers`] asks for at run time. A result has the same bits with either: each number is computed as it is alone, and the compiler
//! fuses no product with a sum. Which crate, and why: docs/decisions/0071-wide-registers.md.

/// Work whose loops a compiler can do for several numbers at once.
pub(in crate::impact) trait Loops {
    /// What comes out.
    type Output;

    /// Does it. What is called and not inlined has narrow registers.
    fn run(self) -> Self::Output;
}

/// Does work with the widest registers of the processor.
#[cfg(target_arch = "x86_64")]
pub(in crate::impact) fn with_wide_registers<L: Loops>(loops: L) -> L::Output {
    struct Dispatched<L>(L);

    impl<L: Loops> pulp::WithSimd for Dispatched<L> {
        type Output = L::Output;

        #[inline(always)]
        fn with_simd<S: pulp::Simd>(self, _registers: S) -> L::Output {
            self.0.run()
        }
    }

    pulp::Arch::new().dispatch(Dispatched(loops))
}

/// Does work with the registers that every processor of this kind has.
#[cfg(not(target_arch = "x86_64"))]
pub(in crate::impact) fn with_wide_registers<L: Loops>(loops: L) -> L::Output {
    loops.run()
}
