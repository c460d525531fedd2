// Changes a network of the format ONNX, which is protocol buffers, so that two threads of a page run it faster. Only what
// `npm run voice` needs. Only Node's own modules.

/** Numbers of fields. */
const GRAPH = 7;
const G = { node: 1, tensor: 5, output: 12, shape: 13 };
const N = { input: 1, output: 2, op: 4, attribute: 5 };
const T = { name: 8 };
const V = { name: 1, type: 2 };

/** The fields of a message: number, contents where they are bytes, and all of the field as it is stored. */
function* fields(bytes) {
  let at = 0;
  const varint = () => {
    let value = 0;
    for (let scale = 1; ; scale *= 128) {
      const byte = bytes[at++];
      value += (byte & 127) * scale;
      if (byte < 128) return value;
    }
  };
  while (at < bytes.length) {
    const begin = at;
    const key = varint();
    const kind = key & 7;
    let value;
    if (kind === 0) varint();
    else if (kind === 2) {
      const length = varint();
      value = bytes.subarray(at, at + length);
      at += length;
    } else at += kind === 1 ? 8 : 4;
    yield { number: key >> 3, value, whole: bytes.subarray(begin, at) };
  }
}

function varint(value) {
  const bytes = [];
  for (; value > 127; value = Math.floor(value / 128)) bytes.push((value % 128) + 128);
  return Buffer.from([...bytes, value]);
}

/** A field whose contents are bytes or a text. */
function field(number, value) {
  const bytes = Buffer.from(value);
  return Buffer.concat([varint(number * 8 + 2), varint(bytes.length), bytes]);
}

/** A tensor of `float32`, as a type. */
const FLOATS = field(1, Buffer.from([8, 1]));

function readNode({ value, whole }) {
  const all = [...fields(value)];
  const of = (number) => all.filter((each) => each.number === number);
  const texts = (number) => of(number).map((each) => each.value.toString());
  return { op: texts(N.op)[0], inputs: texts(N.input), outputs: texts(N.output), attributes: of(N.attribute).map((each) => each.whole), whole };
}

function makeNode(op, inputs, outputs, attributes = []) {
  const parts = [...inputs.map((name) => field(N.input, name)), ...outputs.map((name) => field(N.output, name)), field(N.op, op), ...attributes];
  return { op, inputs, outputs, attributes, whole: field(G.node, Buffer.concat(parts)) };
}

/** Who makes and who takes a value. */
function links(nodes) {
  const makers = new Map(nodes.flatMap((node) => node.outputs.map((name) => [name, node])));
  const takers = new Map();
  for (const node of nodes) for (const name of node.inputs) takers.set(name, [...(takers.get(name) ?? []), node]);
  const next = (node, op) => {
    const [taker, ...others] = takers.get(node.outputs[0]) ?? [];
    return others.length === 0 && taker?.op === op ? taker : undefined;
  };
  return { maker: (name) => makers.get(name), next };
}

/**
 * Convolutions of whole numbers become ones of floats, which more threads share better; their weights stay bytes in
 * the file.
 * What was rounded for them, sounds and biases, is so no more.
 */
function floatConvolutions(nodes) {
  const { maker, next } = links(nodes);
  const changed = new Map();
  const gone = new Set();
  const unpacked = new Set();
  for (const node of nodes.filter(({ op }) => op === 'ConvInteger')) {
    const [quantized, weights, , zero] = node.inputs;
    const add = next(node, 'Add');
    const cast = next(add ?? node, 'Cast');
    const scaled = next(cast, 'Mul');
    // The bias went through a division, two roundings and a change of shape.
    const bias = add && maker(maker(maker(maker(add.inputs[1]).inputs[0]).inputs[0]).inputs[0]).inputs[0];
    const unpack = weights.replace(/_quantized$/, '');
    const made = unpacked.has(unpack) ? [] : [makeNode('DequantizeLinear', [weights, `${unpack}_scale`, zero], [`${unpack}_float`])];
    unpacked.add(unpack);
    const inputs = [maker(quantized).inputs[0], `${unpack}_float`, ...(bias === undefined ? [] : [bias])];
    changed.set(node, [...made, makeNode('Conv', inputs, scaled.outputs, node.attributes)]);
    for (const old of [add, cast, scaled]) gone.add(old);
  }
  return nodes.filter((node) => !gone.has(node)).flatMap((node) => changed.get(node) ?? [node]);
}

/** Nodes of which something is used. */
function used(nodes, outputs) {
  const wanted = new Set([...outputs, ...nodes.flatMap(({ inputs }) => inputs)]);
  const kept = nodes.filter((node) => node.outputs.some((name) => wanted.has(name)));
  return kept.length === nodes.length ? nodes : used(kept, outputs);
}

const nameOf = (message, number) => [...fields(message)].find((each) => each.number === number).value.toString();

/** A model made faster, with a value inside, of floats, as one more output. */
export function tuned(model, output) {
  const top = [...fields(model)];
  const graph = [...fields(top.find(({ number }) => number === GRAPH).value)];
  const of = (number) => graph.filter((each) => each.number === number);
  const outputs = [...of(G.output).map(({ value }) => nameOf(value, V.name)), output];
  const nodes = used(floatConvolutions(of(G.node).map(readNode)), outputs);
  const inputs = new Set(nodes.flatMap((node) => node.inputs));
  const parts = [
    ...nodes,
    ...of(G.tensor).filter(({ value }) => inputs.has(nameOf(value, T.name))),
    // Shapes of values inside are found anew.
    ...graph.filter(({ number }) => number !== G.node && number !== G.tensor && number !== G.shape),
    { whole: field(G.output, Buffer.concat([field(V.name, output), field(V.type, FLOATS)])) },
  ];
  const changed = field(GRAPH, Buffer.concat(parts.map(({ whole }) => whole)));
  return Buffer.concat([...top.filter(({ number }) => number !== GRAPH).map(({ whole }) => whole), changed]);
}
