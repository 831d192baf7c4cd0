// Curves by uPlot, drawn again when their data or the page's colours change. A table says the same to those who do not see it.
import { useEffect, useRef } from "preact/hooks";
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { short } from "./words.ts";
import { isDark, theme } from "../state/theme.ts";

/** `colour`: which of the colours; without it, one after the other. */
export type Curve = { name: string; points: [number, number][]; dashed?: boolean; colour?: number };
type Props = { title: string; x: string; y: string; curves: Curve[]; height?: number };

const PAPER_INK = "#1b222b";
const COLOURS = ["#e8862e", "#3f7fd1", "#2f9e62", "#b3547a", "#8a8f2b", "#7c6bd6"];

/** All curves over one axis: every point of any, `undefined` where a curve has none. */
function joined(curves: Curve[]): uPlot.AlignedData {
  const tables = curves.map(({ points }) => [points.map(([x]) => x), points.map(([, y]) => y)] as uPlot.AlignedData);
  return tables.length > 0 ? uPlot.join(tables) : [[], []];
}

export function Plot({ title, x, y, curves, height = 190 }: Props) {
  const place = useRef<HTMLDivElement>(null);
  const shade = `${theme.value} ${isDark.value}`;
  useEffect(() => {
    const box = place.current;
    if (!box) return;
    const own = getComputedStyle(box).color;
    let ink = own;
    const axis = (label: string, size: number): uPlot.Axis => ({
      label,
      stroke: () => ink,
      // As all numbers of the page, and not as the browser's language has them.
      values: (_, splits) => splits.map((value) => short(value)),
      size,
      labelSize: 18,
      font: "12px system-ui",
      labelFont: "12px system-ui",
      grid: { stroke: "rgba(128,128,128,0.25)" },
      ticks: { stroke: "rgba(128,128,128,0.4)" },
    });
    const plot = new uPlot(
      {
        width: box.clientWidth,
        height,
        scales: { x: { time: false } },
        axes: [axis(x, 32), axis(y, 46)],
        legend: { live: false, markers: { dash: (_, at) => (curves[at - 1]?.dashed ? "dashed" : "solid") } },
        series: [
          { label: x },
          ...curves.map(({ name, dashed, colour }, at) => ({
            label: name,
            stroke: COLOURS[(colour ?? at) % COLOURS.length]!,
            width: 1.6,
            spanGaps: true,
            points: { show: false },
            ...(dashed ? { dash: [6, 4] } : {}),
          })),
        ],
      },
      joined(curves),
      box,
    );
    const resized = new ResizeObserver(() => plot.setSize({ width: box.clientWidth, height }));
    resized.observe(box);
    // Paper is white, whatever the page is.
    const inkOnPaper = () => redraw(PAPER_INK);
    const inkOnPage = () => redraw(own);
    const redraw = (next: string) => {
      ink = next;
      plot.redraw();
    };
    addEventListener("beforeprint", inkOnPaper);
    addEventListener("afterprint", inkOnPage);
    return () => {
      removeEventListener("beforeprint", inkOnPaper);
      removeEventListener("afterprint", inkOnPage);
      resized.disconnect();
      plot.destroy();
    };
  }, [curves, x, y, height, shade]);
  const most = curves.map(
    ({ name, points }) => `${name}: at most ${Math.max(...points.map(([, value]) => value)).toPrecision(4)}`,
  );
  return (
    <figure class="plot">
      <figcaption>{title}</figcaption>
      <div ref={place} role="img" aria-label={`${title}, ${y} over ${x}. ${most.join("; ")}`} />
    </figure>
  );
}
