// The page: hands the node to a worker, and shows what the tool says, as text and nothing else.
(() => {
  const HERE = document.currentScript.src;
  const ENDINGS = ['no findings', 'findings', 'not checked', 'undecided'];
  const NOTHING = /^nothing to check/m;
  const PLACE_OR_RULE = /\bnode\.py:(\d+)(?::\d+)?|(?<=^node\.py:\d+:\d+: )CC\d{3}\b/gm;
  const [node, numbers, check, stop, state, findings] = [
    'node', 'numbers', 'check', 'stop', 'state', 'findings',
  ].map((id) => document.getElementById(id));
  let worker = null;
  let clock = null;

  function start() {
    for (const element of [findings]) {
      element.hidden = true;
    }
    busy('beginning');
    worker ??= hired();
    worker.postMessage(node.value);
  }

  function hired() {
    const made = new Worker(new URL('worker.mjs', HERE), { type: 'module' });
    made.onmessage = ({ data }) => heard(data);
    made.onerror = (event) => failed(event.message || 'the worker cannot be loaded');
    return made;
  }

  function heard(data) {
    if (data.stage) {
      clock.stage = data.stage;
      tick();
    } else if (data.error) {
      failed(data.error);
    } else {
      show(data);
    }
  }

  function show({ status, out, complaints }) {
    fill(findings, complaints + out);
    findings.hidden = false;
    const found = ENDINGS[status] ?? `status ${status}`;
    const ending = status === 0 && NOTHING.test(complaints) ? 'nothing judged' : found;
    idle(`${ending}, ${elapsed().toFixed(1)} s`);
  }

  function failed(reason) {
    end();
    idle(`It did not work: ${reason}`);
  }

  function end() {
    worker?.terminate();
    worker = null;
  }

  // Places lead to their line, rules to their page, and all else stays text: nothing of a node or
  // of a finding is markup.
  function fill(element, text) {
    element.replaceChildren();
    let done = 0;
    for (const found of text.matchAll(PLACE_OR_RULE)) {
      const link = found[1] ? toLine(Number(found[1])) : toRule(found[0]);
      link.textContent = found[0];
      element.append(text.slice(done, found.index), link);
      done = found.index + found[0].length;
    }
    element.append(text.slice(done));
  }

  function toLine(line) {
    const button = document.createElement('button');
    button.addEventListener('click', () => lead(line));
    return button;
  }

  function toRule(code) {
    const link = document.createElement('a');
    link.href = new URL(`../rules/${code}.html`, HERE);
    link.target = '_blank';
    return link;
  }

  function lead(line) {
    const lines = node.value.split('\n');
    const begin = lines.slice(0, line - 1).join('\n').length + (line > 1);
    const height = node.scrollHeight / lines.length;
    node.focus();
    node.setSelectionRange(begin, begin + (lines[line - 1] ?? '').length);
    node.scrollTop = Math.max(0, (line - 4) * height);
    node.scrollLeft = 0;
    node.scrollIntoView({ block: 'nearest' });
  }

  function number() {
    const count = node.value.split('\n').length;
    numbers.textContent = Array.from({ length: count }, (_, n) => n + 1).join('\n');
    numbers.scrollTop = node.scrollTop;
  }

  function busy(stage) {
    [check.disabled, stop.disabled] = [true, false];
    clock = { stage, begun: Date.now(), timer: setInterval(tick, 1000), runs: true };
    tick();
  }

  function idle(text) {
    if (clock) {
      clearInterval(clock.timer);
      clock.runs = false;
    }
    [check.disabled, stop.disabled] = [!node.value, true];
    state.textContent = text;
  }

  function tick() {
    state.textContent = `${clock.stage} … ${Math.round(elapsed())} s`;
  }

  function elapsed() {
    return (Date.now() - clock.begun) / 1000;
  }

  async function ready() {
    if (location.protocol === 'file:') {
      state.textContent = 'A browser runs this only from a server: python3 -m http.server';
      return;
    }
    // Until there is a text, of ours or of the user, there is nothing to check.
    const example = await fetch(new URL('node.py', HERE));
    if (example.ok && !node.value) {
      node.value = await example.text();
      number();
    }
    typed();
  }

  function typed() {
    check.disabled = clock?.runs || !node.value || location.protocol === 'file:';
  }

  check.addEventListener('click', start);
  stop.addEventListener('click', () => {
    end();
    idle('stopped');
  });
  node.addEventListener('input', number);
  node.addEventListener('input', typed);
  node.addEventListener('scroll', () => {
    numbers.scrollTop = node.scrollTop;
  });
  number();
  ready().catch((error) => clock?.runs || idle(`The example is not there: ${error.message}`));
})();
