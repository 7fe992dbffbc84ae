// Draws the charts of a page by Chart.js. The figures of each stand as JSON behind its canvas.

const shortNumber = new Intl.NumberFormat('en', {maximumSignificantDigits: 3, useGrouping: false}).format;
const percent = share => `${shortNumber(100 * share)} %`;

/** Lines that do not touch each other: points that are not numbers separate them. */
const segments = ends => ends.flatMap(([from, to]) => [from, to, {x: NaN, y: NaN}]);

/** A dataset that draws a line without points, for which no tooltip appears. */
const line = (label, data, options) => ({label, data, showLine: true, pointRadius: 0, pointHitRadius: 0, order: 2, ...options});

/** Draws the names of points beside them. */
const pointNames = {
  id: 'pointNames',
  afterDatasetsDraw(chart) {
    const draw = chart.ctx, area = chart.chartArea;
    draw.font = '11px system-ui, sans-serif';
    draw.fillStyle = '#555';
    chart.data.datasets.forEach((set, i) => set.data.forEach((point, k) => {
      if (!point.name || !chart.isDatasetVisible(i)) return;
      const {x, y} = chart.getDatasetMeta(i).data[k], wide = draw.measureText(point.name).width;
      draw.fillText(point.name, x + 8 + wide < area.right ? x + 8 : x - 8 - wide, y - 5);
    }));
  },
};

const shared = {
  responsive: true,
  maintainAspectRatio: false,
  animation: false,
  onClick: (event, found, chart) => {
    const link = found.length && chart.data.datasets[found[0].datasetIndex].data[found[0].index].link;
    if (link) location.hash = link;
  },
  onHover: (event, found) => {
    event.native.target.style.cursor = found.length ? 'pointer' : 'default';
  },
};
const tips = {filter: item => item.raw.tip, callbacks: {label: item => item.raw.tip.split(', ')}};

/** A logarithmic axis with as many numbers as there is room for: 1, or 1, 2 and 5, or all digits of each decade. */
const logarithmic = (min, max, text, callback) => ({
  type: 'logarithmic', min, max, title: {display: true, text}, ticks: {callback: value => callback(value), maxRotation: 0},
  afterBuildTicks: axis => {
    const digits = max / min > 300 ? [1] : max / min > 8 ? [1, 2, 5] : [1, 2, 3, 4, 5, 6, 7, 8, 9];
    axis.ticks = axis.ticks.filter(({value}) => digits.some(digit => Math.abs(value / 10 ** Math.floor(Math.log10(value) + 1e-9) - digit) < 1e-6));
  },
});

/** Error against cost: curves on logarithmic axes. */
function curves(plot) {
  const all = plot.curves.flatMap(curve => curve.points), range = (values, margin) => [Math.min(...values) / margin, Math.max(...values) * margin];
  const [left, right] = range([...all.map(p => p.x), ...(plot.limit ? [plot.limit] : [])], 1.25);
  const [low, high] = range([...all.map(p => p.y), ...(plot.floor ? [plot.floor] : [])].filter(y => y > 0), 1.25);
  const datasets = [];
  for (const {name, color, points} of plot.curves) {
    const own = {group: name, borderColor: color};
    datasets.push({label: name, data: points, showLine: true, borderWidth: 1.8, pointRadius: 5, pointHoverRadius: 7, backgroundColor: color, order: 1, ...own,
      pointBorderColor: points.map(p => p.warned ? '#b00020' : p.best ? '#111' : '#fff'), pointBorderWidth: points.map(p => p.warned || p.best ? 2 : 1.2)});
    const whiskers = points.filter(p => p.interval > 0).map(p => [{x: p.x, y: Math.max(p.y - p.interval, low)}, {x: p.x, y: p.y + p.interval}]);
    if (whiskers.length) datasets.push(line('', segments(whiskers), {borderWidth: 1.8, ...own}));
  }
  const best = all.filter(p => p.best).sort((a, b) => a.x - b.x).map(({x, y}) => ({x, y}));
  if (best.length) datasets.push(line('no other point beats', best, {borderColor: '#ffd84d90', borderWidth: 9, order: 3}));
  if (plot.floor) datasets.push(line('noise of the reference', [{x: left, y: plot.floor}, {x: right, y: plot.floor}], {borderColor: '#888', borderWidth: 1, borderDash: [3, 4]}));
  if (plot.limit) datasets.push(line(plot.limitName, [{x: plot.limit, y: low}, {x: plot.limit, y: high}], {borderColor: '#b00020', borderWidth: 1, borderDash: [6, 3]}));
  return {
    type: 'scatter',
    data: {datasets},
    options: {
      ...shared,
      scales: {
        x: logarithmic(left, right, plot.xLabel, shortNumber),
        y: logarithmic(low, high, plot.yLabel, percent),
      },
      plugins: {
        tooltip: tips,
        legend: {
          labels: {usePointStyle: true, boxHeight: 6, filter: item => item.text},
          // A curve and its intervals are hidden and shown together.
          onClick: (event, item, {chart}) => {
            const group = chart.data.datasets[item.datasetIndex].group, show = !chart.isDatasetVisible(item.datasetIndex);
            chart.data.datasets.forEach((set, i) => {
              if (i == item.datasetIndex || (group && set.group == group)) chart.setDatasetVisibility(i, show);
            });
            chart.update();
          },
        },
      },
    },
    plugins: [pointNames],
  };
}

/** Figures of either sign, below each other. */
function differences({rows}) {
  const labels = rows.map(r => [r.name, `${percent(r.mean)} ± ${percent(r.interval)}`]);
  return {
    type: 'scatter',
    data: {
      datasets: rows.flatMap((r, i) => [
        {data: [{x: r.mean, y: i, tip: labels[i].join(', ')}], pointRadius: 5, backgroundColor: r.color},
        line('', [{x: r.mean - r.interval, y: i}, {x: r.mean + r.interval, y: i}], {borderColor: r.color, borderWidth: 1.8}),
      ]),
    },
    options: {
      ...shared,
      scales: {
        x: {ticks: {callback: x => percent(x)}, grid: {color: ({tick}) => tick.value == 0 ? '#333' : '#e5e5e5'}},
        y: {type: 'linear', min: -0.5, max: rows.length - 0.5, reverse: true, grid: {display: false}, afterBuildTicks: axis => {
          axis.ticks = rows.map((r, value) => ({value}));
        }, ticks: {callback: i => labels[i]}},
      },
      plugins: {tooltip: tips, legend: {display: false}},
    },
  };
}

addEventListener('DOMContentLoaded', () => {
  for (const canvas of document.querySelectorAll('.drawing canvas')) {
    const figures = JSON.parse(canvas.nextElementSibling.textContent);
    const chart = new Chart(canvas, figures.rows ? differences(figures) : curves(figures));
    // Screen readers speak this text, and tests read it.
    const points = chart.data.datasets.flatMap((set, i) => set.data.flatMap((p, k) => p.tip ? [chart.getDatasetMeta(i).data[k]] : []));
    const seen = points.filter(({x, y}) => x >= chart.chartArea.left && x <= chart.chartArea.right && y >= chart.chartArea.top && y <= chart.chartArea.bottom);
    canvas.setAttribute('aria-label', `${figures.title}: ${seen.length} points`);
  }
});
