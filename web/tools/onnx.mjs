// Reads and writes networks of the format ONNX, for `npm run voice`.

import onnxProto from 'onnx-proto';

const { onnx } = onnxProto;

/** A network with a value inside, of floats, as one more output. */
export function withOutput(bytes, name) {
  const model = onnx.ModelProto.decode(bytes);
  const type = onnx.TypeProto.create({ tensorType: { elemType: onnx.TensorProto.DataType.FLOAT } });
  model.graph.output.push(onnx.ValueInfoProto.create({ name, type }));
  return onnx.ModelProto.encode(model).finish();
}
