// Changes a network of the format ONNX for pages, for `npm run voice`.

import onnxProto from 'onnx-proto';

const { onnx } = onnxProto;

/** Returns the producers and consumers of values, by name. */
function linksOf(nodes) {
  const makers = new Map(nodes.flatMap((node) => node.output.map((name) => [name, node])));
  const takers = new Map();
  for (const node of nodes) for (const name of node.input) takers.set(name, [...(takers.get(name) ?? []), node]);
  return {
    maker: (name) => makers.get(name),
    /** Returns the only consumer of this node's output, if it has the given kind. */
    next(node, kind) {
      const [taker, ...others] = takers.get(node.output[0]) ?? [];
      return others.length === 0 && taker?.opType === kind ? taker : undefined;
    },
  };
}

/** Returns the name of a convolution's bias before it was rounded, by a division, two roundings and a change of shape. */
function biasOf(add, maker) {
  let name = add.input[1];
  for (let i = 0; i < 4; i++) name = maker(name).input[0];
  return name;
}

/**
 * Convolutions of whole numbers become ones of floats, which two threads share better: *measured* in Chromium, five to
 * twenty words, 1.0 of the sound's length instead of 1.25 to 1.5. Their weights stay bytes in the file.
 */
function floatConvolutions(nodes) {
  const { maker, next } = linksOf(nodes);
  const unpacked = new Set();
  const gone = new Set();
  const changed = nodes.flatMap((node) => {
    if (node.opType !== 'ConvInteger') return [node];
    const [quantized, weights, , zero] = node.input;
    const add = next(node, 'Add');
    const cast = next(add ?? node, 'Cast');
    const scaled = next(cast, 'Mul');
    for (const old of [add, cast, scaled]) gone.add(old);
    const base = weights.replace(/_quantized$/, '');
    const unpack = unpacked.has(base) ? [] : [onnx.NodeProto.create({ opType: 'DequantizeLinear', input: [weights, `${base}_scale`, zero], output: [`${base}_float`] })];
    unpacked.add(base);
    const input = [maker(quantized).input[0], `${base}_float`, ...(add === undefined ? [] : [biasOf(add, maker)])];
    return [...unpack, onnx.NodeProto.create({ opType: 'Conv', input, output: scaled.output, attribute: node.attribute })];
  });
  return changed.filter((node) => !gone.has(node));
}

/** Returns the nodes whose output is used. */
function used(nodes, outputs) {
  const wanted = new Set([...outputs, ...nodes.flatMap(({ input }) => input)]);
  const kept = nodes.filter(({ output }) => output.some((name) => wanted.has(name)));
  return kept.length === nodes.length ? nodes : used(kept, outputs);
}

/** Returns a network that runs faster in a page, with an internal float value as one more output. */
export function forPages(bytes, name) {
  const model = onnx.ModelProto.decode(bytes);
  const { graph } = model;
  const type = onnx.TypeProto.create({ tensorType: { elemType: onnx.TensorProto.DataType.FLOAT } });
  graph.output.push(onnx.ValueInfoProto.create({ name, type }));
  graph.node = used(
    floatConvolutions(graph.node),
    graph.output.map((output) => output.name),
  );
  const inputs = new Set(graph.node.flatMap(({ input }) => input));
  graph.initializer = graph.initializer.filter((tensor) => inputs.has(tensor.name));
  // Shapes of intermediate values are inferred again.
  graph.valueInfo = [];
  return onnx.ModelProto.encode(model).finish();
}
