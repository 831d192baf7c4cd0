//! A refusal as a terminal shows it: file, line, column, the text itself with the place underlined, and the remedy.

use miette::{GraphicalReportHandler, GraphicalTheme, LabeledSpan, MietteDiagnostic, NamedSource, Report, Severity};

use super::refusal::{Place, Refusal};

/// Longest line of a file that is shown, bytes.
const LONGEST_LINE: usize = 400;

impl Refusal {
    /// The place, when the lines around it can be shown.
    fn shown(&self) -> Option<&Place> {
        let place = self.place.as_ref()?;
        let [line, _] = place.line_column();
        let last = line + place.source.text.get(place.span.clone()).map_or(0, |text| text.matches('\n').count()) + 1;
        let around = place.source.text.lines().take(last).skip(line.saturating_sub(2));
        around.map(str::len).all(|bytes| bytes <= LONGEST_LINE).then_some(place)
    }

    /// The diagnostic a person reads: file, line, column, the text, and the remedy. Plain text.
    pub fn render(&self) -> String {
        let message = match (&self.place, self.shown()) {
            (Some(place), None) => {
                let [line, column] = place.line_column();
                format!("{} ({}:{line}:{column})", self.message(), place.source.name)
            }
            _ => self.message(),
        };
        let remedy = self.remedy();
        let mut diagnostic = MietteDiagnostic::new(message).with_severity(Severity::Error).with_help(remedy.clone());
        if let Some(place) = self.shown() {
            diagnostic = diagnostic.with_label(LabeledSpan::new_with_span(Some("here".into()), place.span.clone()));
        }
        let mut report = Report::new(diagnostic);
        if let Some(place) = self.shown() {
            report = report.with_source_code(NamedSource::new(&place.source.name, place.source.text.clone()));
        }
        let handler = GraphicalReportHandler::new_themed(GraphicalTheme::unicode_nocolor()).with_width(110);
        let mut text = String::new();
        match handler.render_report(&mut text, report.as_ref()) {
            Ok(()) => text,
            Err(_) => format!("{}\nhelp: {remedy}\n", self.message()),
        }
    }
}
