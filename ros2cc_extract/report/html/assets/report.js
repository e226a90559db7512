'use strict';
(() => {
  const root = document.documentElement;
  const asked = new URLSearchParams(location.search);
  const system = matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light';
  root.dataset.theme = asked.get('theme') || system;
  document.querySelector('.theme').addEventListener('click', () => {
    root.dataset.theme = root.dataset.theme === 'dark' ? 'light' : 'dark';
  });

  function make(name, className, text) {
    const element = document.createElement(name);
    if (className) element.className = className;
    if (text !== undefined) element.textContent = text;
    return element;
  }

  /** What the script adds later, such as source lines, is not searched. */
  const searched = [...document.querySelectorAll('.finding, .index tbody tr, .unit')].map(
    (element) => [element, element.textContent.toLowerCase()],
  );
  const search = document.querySelector('.search');
  const tiles = [...document.querySelectorAll('.tile')];

  function filter() {
    const words = search.value.toLowerCase().split(/\s+/).filter(Boolean);
    const kind = tiles.find((tile) => tile.getAttribute('aria-pressed') === 'true')?.dataset.filter;
    let found = 0;
    let cards = 0;
    for (const [element, text] of searched) {
      const isOther = kind && element.dataset.kind && element.dataset.kind !== kind;
      element.hidden = Boolean(isOther) || !words.every((word) => text.includes(word));
      cards += Number('kind' in element.dataset);
      found += Number('kind' in element.dataset && !element.hidden);
    }
    const notes = document.querySelector('.notes');
    if (notes) {
      const shown = notes.querySelectorAll('.finding:not([hidden])').length;
      notes.open = shown > 0 && (kind === 'note' || words.length > 0);
      notes.hidden = shown === 0;
    }
    const isAll = !kind && !words.length;
    document.querySelector('.found').value = isAll ? '' : `${found} of ${cards} findings`;
  }
  for (const tile of tiles) {
    tile.addEventListener('click', () => {
      const on = tile.getAttribute('aria-pressed') !== 'true';
      for (const other of tiles) other.setAttribute('aria-pressed', String(on && other === tile));
      filter();
    });
  }
  search.addEventListener('input', filter);
  search.value = asked.get('search') || '';
  if (search.value) filter();

  function openTarget() {
    const target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
    if (!target) return;
    for (let each = target; each; each = each.parentElement) {
      if (each.tagName === 'DETAILS') each.open = true;
    }
    target.scrollIntoView();
  }
  addEventListener('hashchange', openTarget);

  /** Lines of a file by their numbers; the page holds those that are shown somewhere, once. */
  const files = new Map();
  function linesOf(id) {
    if (!files.has(id)) {
      const lines = new Map();
      for (const block of document.getElementById(id).querySelectorAll('pre')) {
        const first = Number(block.dataset.from);
        block.textContent.split('\n').forEach((text, n) => lines.set(first + n, text));
      }
      files.set(id, lines);
    }
    return files.get(id);
  }

  function showLines(link) {
    const lines = linesOf(link.hash.slice(1));
    const line = Number(link.dataset.line);
    const around = Number(link.dataset.around || 0);
    const block = make('pre', 'source');
    block.tabIndex = 0;
    for (let number = line - around; number <= line + around; number += 1) {
      if (lines.has(number)) {
        const row = make('span', number === line ? 'line here' : 'line');
        row.append(make('span', 'number', String(number).padStart(5)), ` ${lines.get(number)}\n`);
        block.append(row);
      }
    }
    link.parentElement.append(block);
  }
  document.querySelectorAll('a.place').forEach(showLines);

  const SVG = 'http://www.w3.org/2000/svg';
  function svg(name, attributes) {
    const element = document.createElementNS(SVG, name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    return element;
  }

  function arrowHead(id, className) {
    const marker = svg('marker', {
      id, viewBox: '0 0 8 8', refX: 7, refY: 4, markerWidth: 7, markerHeight: 7,
      orient: 'auto', markerUnits: 'userSpaceOnUse',
    });
    marker.append(svg('path', { d: 'M0 0L8 4L0 8z', class: className }));
    return marker;
  }

  function drawArrows(executor, number) {
    executor.querySelector('.arrows')?.remove();
    const layer = svg('svg', { class: 'arrows', 'aria-hidden': 'true' });
    layer.append(arrowHead(`head-${number}`, ''), arrowHead(`bad-${number}`, 'bad'));
    const frame = executor.getBoundingClientRect();
    for (const from of executor.querySelectorAll('[data-waits]')) {
      for (const id of from.dataset.waits.split(' ')) {
        const to = id && document.getElementById(id);
        if (to) layer.append(arrow(from, to, frame, number));
      }
    }
    executor.append(layer);
  }

  function arrow(from, to, frame, number) {
    const bad = from.querySelector('.badge.error') !== null;
    return svg('path', {
      d: curve(from.getBoundingClientRect(), to.getBoundingClientRect(), frame),
      class: bad ? 'bad' : '',
      'marker-end': `url(#${bad ? 'bad' : 'head'}-${number})`,
    });
  }

  /** Beside the boxes within a column, below them within a row, else straight across. */
  function curve(a, b, frame) {
    const ax = a.left + a.width / 2 - frame.left;
    const bx = b.left + b.width / 2 - frame.left;
    if (Math.abs(ax - bx) < 20) {
      const x = Math.max(a.right, b.right) - frame.left;
      const ay = a.top + a.height / 2 - frame.top;
      const by = b.top + b.height / 2 - frame.top;
      return `M${x} ${ay}C${x + 26} ${ay} ${x + 26} ${by} ${x} ${by}`;
    }
    if (a.top < b.bottom && b.top < a.bottom) {
      const ay = a.bottom - frame.top;
      const by = b.bottom - frame.top;
      const low = Math.max(ay, by) + 44;
      return `M${ax} ${ay}C${ax} ${low} ${bx} ${low} ${bx} ${by}`;
    }
    const down = a.top < b.top;
    const ay = (down ? a.bottom : a.top) - frame.top;
    const by = (down ? b.top : b.bottom) - frame.top;
    const middle = (ay + by) / 2;
    return `M${ax} ${ay}C${ax} ${middle} ${bx} ${middle} ${bx} ${by}`;
  }

  const executors = [...document.querySelectorAll('.executor')];
  /** What is folded has no size yet. */
  const drawAll = () => executors.forEach((executor, number) => {
    if (!executor.closest('details:not([open])')) drawArrows(executor, number);
  });
  addEventListener('resize', drawAll);
  for (const unit of document.querySelectorAll('.unit')) unit.addEventListener('toggle', drawAll);
  drawAll();

  const { words, runs } = JSON.parse(document.getElementById('runs').textContent);

  /** Put words for their numbers; the order of the fields is that of report/html/runs.py. */
  function runOf(number) {
    const [lanes, steps, cycleFrom, ends] = runs[number];
    const stay = ([text, since, until, marks, colour]) => ({
      text: words[text], since, until, colour,
      rest: Boolean(marks & 1), blocked: Boolean(marks & 2),
    });
    return {
      lanes: lanes.map(([name, stays]) => ({ name: words[name], stays: stays.map(stay) })),
      steps: steps.map(([says, places, changes]) => ({
        says: says.map(([lane, text]) => [words[lane], words[text]]),
        places: places.map((place) => words[place]),
        changes: changes.map((change) => words[change]),
      })),
      cycleFrom,
      ends,
    };
  }

  class Timeline {
    constructor(place, run) {
      this.run = run;
      this.last = run.steps.length;
      this.current = 0;
      this.timer = null;
      this.stays = [];
      this.numbers = [];
      place.replaceChildren(this.lanes(), this.player(), this.says = make('div', 'says'));
      place.tabIndex = 0;
      place.addEventListener('keydown', (event) => this.onKey(event));
      this.show(this.last);
    }

    lanes() {
      const outer = make('div', 'lanes');
      const grid = make('div', 'grid');
      const rows = this.run.lanes.length + 1;
      grid.style.gridTemplateColumns = `max-content repeat(${this.last + 1}, minmax(58px, 1fr))`;
      const corner = make('div', 'lane-name', 'step');
      corner.style.gridArea = '1 / 1';
      grid.append(corner);
      for (let step = 0; step <= this.last; step += 1) grid.append(this.number(step));
      this.run.lanes.forEach((lane, row) => this.addLane(grid, lane, row + 2));
      this.cursor = make('div', 'cursor');
      grid.append(this.cursor);
      this.cursor.dataset.rows = String(rows + 1);
      if (this.run.cycleFrom !== null) {
        const cycle = make('div', 'cycle');
        cycle.title = 'repeats forever';
        cycle.style.gridArea = `1 / ${this.run.cycleFrom + 2} / ${rows + 1} / ${this.last + 3}`;
        grid.append(cycle);
      }
      outer.append(grid);
      return outer;
    }

    number(step) {
      const button = make('button', 'step-number', step === 0 ? 'start' : String(step));
      button.style.gridArea = `1 / ${step + 2}`;
      button.addEventListener('click', () => this.show(step));
      this.numbers.push(button);
      return button;
    }

    addLane(grid, lane, row) {
      const name = make('div', 'lane-name', lane.name);
      name.title = lane.name;
      name.style.gridArea = `${row} / 1`;
      grid.append(name);
      for (const stay of lane.stays) {
        const bar = make('div', stay.rest ? 'stay rest' : 'stay', stay.text);
        bar.title = stay.text;
        bar.style.gridArea = `${row} / ${stay.since + 2} / auto / ${stay.until + 2}`;
        if (stay.colour !== null) bar.dataset.colour = stay.colour;
        if (stay.blocked) bar.classList.add('blocked');
        grid.append(bar);
        this.stays.push([stay, bar]);
      }
      if (lane.stays.length === 1) this.addDots(grid, lane.name, row);
    }

    /** A process that never moves still speaks: a dot at each step at which it does. */
    addDots(grid, name, row) {
      this.run.steps.forEach((step, index) => {
        const said = step.says.filter(([lane]) => lane === name).map(([, text]) => text);
        if (!said.length) return;
        const dot = make('div', 'dot');
        dot.title = said.join('; ');
        dot.style.gridArea = `${row} / ${index + 3}`;
        grid.append(dot);
        this.stays.push([{ since: index + 1 }, dot]);
      });
    }

    player() {
      const bar = make('div', 'player');
      const button = (text, title, act) => {
        const made = make('button', '', text);
        made.title = title;
        made.addEventListener('click', act);
        bar.append(made);
        return made;
      };
      button('|◀', 'to the start', () => this.show(0));
      button('◀', 'one step back', () => this.show(this.current - 1));
      this.play = button('▶', 'play', () => this.toggle());
      button('▶|', 'one step on', () => this.next());
      this.slider = make('input');
      this.slider.type = 'range';
      this.slider.min = 0;
      this.slider.max = this.last;
      this.slider.setAttribute('aria-label', 'step');
      this.slider.addEventListener('input', () => this.show(Number(this.slider.value)));
      bar.append(this.slider);
      return bar;
    }

    next() {
      if (this.current < this.last) this.show(this.current + 1);
      else if (this.run.cycleFrom !== null) this.show(this.run.cycleFrom);
      else this.stop();
    }

    toggle() {
      if (this.timer) return this.stop();
      if (this.current === this.last) this.show(0);
      this.play.textContent = '■';
      this.timer = setInterval(() => this.next(), 900);
      return undefined;
    }

    stop() {
      clearInterval(this.timer);
      this.timer = null;
      this.play.textContent = '▶';
    }

    onKey(event) {
      const moves = { ArrowLeft: -1, ArrowRight: 1 };
      if (event.target === this.slider || !(event.key in moves)) return;
      event.preventDefault();
      this.show(this.current + moves[event.key]);
    }

    show(step) {
      this.current = Math.min(Math.max(step, 0), this.last);
      this.slider.value = this.current;
      const column = this.current + 2;
      this.cursor.style.gridArea = `1 / ${column} / ${this.cursor.dataset.rows} / ${column + 1}`;
      for (const [stay, bar] of this.stays) {
        bar.classList.toggle('future', stay.since > this.current);
      }
      this.numbers.forEach((button, number) => {
        if (number === this.current) button.setAttribute('aria-current', 'step');
        else button.removeAttribute('aria-current');
      });
      this.tell();
      this.scroll();
    }

    scroll() {
      const outer = this.cursor.closest('.lanes');
      const number = this.numbers[this.current];
      if (!outer || !number.offsetParent) return;
      const left = number.offsetLeft - 160;
      const right = number.offsetLeft + number.offsetWidth - outer.clientWidth;
      if (outer.scrollLeft > left) outer.scrollLeft = left;
      if (outer.scrollLeft < right) outer.scrollLeft = right + 20;
    }

    tell() {
      const step = this.run.steps[this.current - 1];
      this.says.replaceChildren();
      if (!step) {
        this.says.append(make('div', '', 'The start: nothing has happened yet.'));
        return;
      }
      const head = `${this.current}. ${step.says.map(([, text]) => text).join('; ')}`;
      const line = make('div', '', head);
      for (const place of step.places) line.append(' ', make('span', 'place', place));
      this.says.append(line);
      if (step.changes.length) this.says.append(make('div', 'changes', step.changes.join(', ')));
      const end = this.current === this.last ? this.ending() : '';
      if (end) this.says.append(make('b', '', end));
    }

    ending() {
      if (this.run.cycleFrom !== null) {
        return `From step ${this.run.cycleFrom} on, this repeats forever.`;
      }
      const words = {
        deadlock: 'Nothing can move any more.', idle: 'It may stay like this forever.',
      };
      return words[this.run.ends] || '';
    }
  }

  /** A run is drawn when somebody opens it. */
  function build(folded) {
    if (!folded.open || folded.dataset.built) return;
    folded.dataset.built = 'yes';
    const place = make('div', 'timeline');
    folded.append(place);
    new Timeline(place, runOf(Number(folded.dataset.run)));
  }
  for (const folded of document.querySelectorAll('details[data-run]')) {
    folded.addEventListener('toggle', () => build(folded));
    build(folded);
  }
  openTarget();
})();
