//! Figures of a frame's bill of materials that a study can say of each row.

use crate::export::bill::{Bill, BuyLine};
use crate::variant::Better;

/// A figure of the bill.
pub struct BillFigure {
    /// Its name.
    pub name: &'static str,
    /// Its unit; of a price, the currency of the catalogue.
    pub unit: &'static str,
    /// Whether less of it is better.
    pub better: Better,
    of: fn(&Bill) -> Option<f64>,
}

/// Every figure of the bill.
pub static BILL_FIGURES: [BillFigure; 3] = [
    BillFigure { name: "price.bought", unit: "", better: Better::Less, of: price },
    BillFigure { name: "price.unknown", unit: "", better: Better::Neither, of: |bill| Some(unknown(bill) as f64) },
    BillFigure { name: "print.time", unit: "h", better: Better::Less, of: |bill| bill.print_h },
];

impl BillFigure {
    /// Of a bill; none where it does not say it.
    pub(super) fn of_bill(&self, bill: &Bill) -> Option<f64> {
        (self.of)(bill)
    }
}

/// What stands in a catalogue: extra masses such as wiring, and supplies such as glue, have no place for a price.
fn catalogued(bill: &Bill) -> impl Iterator<Item = &BuyLine> {
    bill.buy.iter().filter(|line| line.kind != "extra" && line.kind != "supply")
}

fn unknown(bill: &Bill) -> usize {
    catalogued(bill).filter(|line| line.price.is_none()).count()
}

/// The sum of all prices; none where one is not known, or where they are in several currencies.
fn price(bill: &Bill) -> Option<f64> {
    match bill.prices[..] {
        [(_, sum)] if unknown(bill) == 0 => Some(sum),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::export::bill::bill;
    use crate::frame::assembly::{Design, mass};
    use crate::params::{Frame, FrameFile};

    #[test]
    fn planted_a_price_is_the_sum_of_all_or_none() {
        let mut frame = Frame::resolve(&FrameFile::load("cognifly").expect("a preset")).expect("a frame");
        for item in frame.bought.values_mut() {
            (item.part.price, item.part.currency, item.part.price_source) = (Some(2.5), Some("EUR".into()), Some("a shop".into()));
        }
        let mut design = Design::new(frame).expect("can be made");
        let masses = mass::table(&design);
        let of = |design: &Design| bill(design, &masses, None);
        let whole = of(&design);
        let pieces: u32 = catalogued(&whole).map(|line| line.quantity).sum();
        assert!(pieces > 10 && whole.buy.iter().any(|line| line.kind == "extra"), "{pieces}");
        assert_eq!((price(&whole), unknown(&whole)), (Some(2.5 * f64::from(pieces)), 0));
        assert!(BILL_FIGURES.iter().all(|figure| (figure.of)(&whole).is_some_and(f64::is_finite)));

        let first = design.frame.bought.values_mut().next().expect("something is bought");
        first.part.currency = Some("USD".into());
        assert_eq!(price(&of(&design)), None, "two currencies have no sum");
        let first = design.frame.bought.values_mut().next().expect("something is bought");
        first.part.price = None;
        assert_eq!((price(&of(&design)), unknown(&of(&design))), (None, 1));
    }
}
