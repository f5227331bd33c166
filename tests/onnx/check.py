"""check.py MODEL.onnx MODEL.safetensors: the file is valid ONNX of the opset, names and shapes that
docs/onnx.md lists, and keeps the model's metadata."""

import json
import sys

import onnx

model = onnx.load(sys.argv[1])
onnx.checker.check_model(model, full_check=True)
with open(sys.argv[2], 'rb') as file:
    metadata = json.loads(file.read(int.from_bytes(file.read(8), 'little')))['__metadata__']
assert {entry.key: entry.value for entry in model.metadata_props} == metadata
assert [(opset.domain, opset.version) for opset in model.opset_import] == [('', 17)]


def columns(values):
    out = {}
    for value in values:
        batch, width = value.type.tensor_type.shape.dim
        assert batch.dim_param == 'batch' and value.doc_string
        assert value.type.tensor_type.elem_type == onnx.TensorProto.FLOAT
        out[value.name] = width.dim_value
    return out


styles = len(metadata['styles'].splitlines())
if metadata['recipe'] == 'panache':
    expected = {'windows': 396}, {'changes': 67, 'log_rates': 1, 'contacts': 2, 'gate': 1}
else:
    expected = {'windows': 780}, {'poses': 130, 'log_rates': 1, 'contacts': 2}
assert columns(model.graph.input) == {**expected[0], 'strengths': styles}
assert columns(model.graph.output) == expected[1]
