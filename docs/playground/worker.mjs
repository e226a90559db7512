// Python in a thread of its own: checks the texts it is sent, one after the other.

const ARGUMENTS = [
  'check', 'node.py', '--engine', 'reference', '--no-cache', '--strict', '--max-seconds', '60',
];
const PREPARE = `
import io, os, sys
sys.path.insert(0, '/tool')
os.mkdir('/checked')
os.chdir('/checked')
from ros2cc_extract.cli.main import main

def check(*arguments):
    told, complaints = io.StringIO(), io.StringIO()
    status = main(arguments, told, complaints)
    return status, told.getvalue(), complaints.getvalue()

check
`;
let prepared = null;

async function prepare() {
  postMessage({ stage: 'loading Python (15 MB, once)' });
  const { loadPyodide } = await import('./pyodide/pyodide.mjs');
  const [python, tool] = await Promise.all([loadPyodide(), fetched('tool.zip')]);
  postMessage({ stage: 'loading the tool' });
  python.unpackArchive(tool, 'zip', { extractDir: '/tool' });
  return { python, check: python.runPython(PREPARE) };
}

async function fetched(name) {
  const response = await fetch(name);
  if (!response.ok) {
    throw new Error(`${name}: ${response.status} ${response.statusText}`);
  }
  return response.arrayBuffer();
}

// What the text says is data: it becomes a file, which the tool parses and never imports.
async function checked(text) {
  const { python, check } = await (prepared ??= prepare());
  postMessage({ stage: 'checking' });
  python.FS.writeFile('/checked/node.py', text);
  const answer = check(...ARGUMENTS);
  const [status, out, complaints] = answer.toJs();
  answer.destroy();
  return { status, out, complaints };
}

function reason(error) {
  if (error instanceof RangeError) {
    return 'the text is nested too deeply for a browser';
  }
  const lines = String(error?.message ?? error).trim().split('\n');
  return lines[lines.length - 1];
}

onmessage = async (event) => {
  try {
    postMessage(await checked(event.data));
  } catch (error) {
    postMessage({ error: reason(error) });
  }
};
