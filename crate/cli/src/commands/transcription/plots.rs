//! Statistics of a transcription as a picture: bars in panels.

use anyhow::{Result, anyhow};
use plotters::coord::Shift;
use plotters::prelude::*;
use raconteur_annotate::gestura::{Statistics, Tally};

/// Width and height of the picture, pixels.
const SIZE: (u32, u32) = (1200, 900);
/// Number of panels down and across.
const PANELS: (usize, usize) = (3, 2);
/// Colour of the bars.
const BAR: RGBColor = RGBColor(0x4a, 0x7b, 0xa6);
/// Colour of lines over the bars.
const LINE: RGBColor = RGBColor(0x22, 0x22, 0x22);
/// Number of hand shapes shown.
const SHAPES: usize = 12;
const TITLE: (&str, u32) = ("sans-serif", 20);
const LABEL: (&str, u32) = ("sans-serif", 14);

/// Bar with its label, its length, and the half length of a line over its end.
struct Bar {
    label: String,
    value: f64,
    deviation: f64,
}

type Panel<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// Returns the picture as SVG.
pub(super) fn plots(statistics: &Statistics) -> Result<String> {
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, SIZE).into_drawing_area();
        root.fill(&WHITE).map_err(failed)?;
        let panels = root.split_evenly(PANELS);
        let charts = [
            (
                "Duration of phases, s (mean and deviation)",
                durations(statistics),
            ),
            ("Gestures in each half minute", rate(statistics)),
            ("Dimensions", counts(&statistics.dimensions)),
            ("Hands", counts(&statistics.hands)),
            ("Hand shapes, by phases", shapes(statistics)),
            ("Gestures by beat filter score", scores(statistics)),
        ];
        for (panel, (title, bars)) in panels.iter().zip(charts) {
            draw(panel, title, &bars)?;
        }
        root.present().map_err(failed)?;
    }
    Ok(svg)
}

fn failed(error: impl std::fmt::Display) -> anyhow::Error {
    anyhow!("drawing the statistics: {error}")
}

fn draw(panel: &Panel<'_>, title: &str, bars: &[Bar]) -> Result<()> {
    let most = bars
        .iter()
        .map(|bar| bar.value + bar.deviation)
        .fold(0.0, f64::max);
    let mut chart = ChartBuilder::on(panel)
        .caption(title, TITLE)
        .margin(14)
        .x_label_area_size(24)
        .y_label_area_size(150)
        // The first bar is at the top.
        .build_cartesian_2d(0.0..(1.08 * most).max(1e-3), bars.len().max(1) as f64..0.0)
        .map_err(failed)?;
    let label = |y: &f64| {
        let middle = (y.fract() - 0.5).abs() < 0.01;
        let bar = bars.get(y.floor() as usize).filter(|_| middle);
        bar.map_or_else(String::new, |bar| bar.label.clone())
    };
    chart
        .configure_mesh()
        .disable_mesh()
        .x_labels(6)
        // A label in the middle of each bar.
        .y_labels(2 * bars.len() + 1)
        .y_label_formatter(&label)
        .label_style(LABEL)
        .draw()
        .map_err(failed)?;
    let rows = || bars.iter().enumerate().map(|(row, bar)| (row as f64, bar));
    let filled = rows()
        .map(|(y, bar)| Rectangle::new([(0.0, y + 0.15), (bar.value, y + 0.85)], BAR.filled()));
    chart.draw_series(filled).map_err(failed)?;
    let lines = rows()
        .filter(|(_, bar)| bar.deviation > 0.0)
        .map(|(y, bar)| {
            let ends = [bar.value - bar.deviation, bar.value + bar.deviation];
            PathElement::new(ends.map(|x| (x.max(0.0), y + 0.5)), LINE.stroke_width(2))
        });
    chart.draw_series(lines).map_err(failed)?;
    Ok(())
}

fn bar(label: impl Into<String>, value: f64) -> Bar {
    Bar {
        label: label.into(),
        value,
        deviation: 0.0,
    }
}

fn durations(statistics: &Statistics) -> Vec<Bar> {
    let phases = statistics.phases.iter();
    phases
        .map(|phase| Bar {
            deviation: phase.deviation_secs,
            ..bar(phase.name, phase.mean_secs)
        })
        .collect()
}

fn rate(statistics: &Statistics) -> Vec<Bar> {
    let counts = statistics.per_half_minute.iter().enumerate();
    let label = |half: usize| format!("{}:{:02}", half / 2, 30 * (half % 2));
    counts
        .map(|(half, &count)| bar(label(half), count as f64))
        .collect()
}

fn counts(tallies: &[Tally]) -> Vec<Bar> {
    tallies
        .iter()
        .map(|tally| bar(tally.name, tally.count as f64))
        .collect()
}

fn shapes(statistics: &Statistics) -> Vec<Bar> {
    let shapes = statistics.shapes.iter().take(SHAPES);
    shapes
        .map(|&(id, count)| bar(id.to_string(), count as f64))
        .collect()
}

fn scores(statistics: &Statistics) -> Vec<Bar> {
    let scores = statistics.beat_scores.iter().enumerate();
    scores
        .map(|(score, &count)| bar(score.to_string(), count as f64))
        .collect()
}
