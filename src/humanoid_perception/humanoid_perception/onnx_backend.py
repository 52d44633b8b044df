# SPDX-License-Identifier: Apache-2.0
"""Object detection by a YOLO model in ONNX format."""

from __future__ import annotations

import ast
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from humanoid_common.paths import expanded_path
from humanoid_perception.detection import Color, Depth, Detection, DetectorError, is_cut
from humanoid_perception.yolo import (
    AUTO,
    box_of,
    candidates_in,
    END_TO_END,
    layout_of,
    Letterbox,
    letterbox_size,
    suppressed,
)
import numpy as np
import numpy.typing as npt
import yaml

__all__ = ['OnnxDetector', 'names_in_file']

_TYPES: dict[str, tuple[Any, float]] = {
    'tensor(float)': (np.float32, 255.0),
    'tensor(float16)': (np.float16, 255.0),
    'tensor(uint8)': (np.uint8, 1.0),
}
_USUAL_SIZE_PX, _USUAL_STRIDE_PX = 640, 32
_LARGEST_PX = 4096
_TASKS = {'segment': 'segmentation', 'pose': 'poses', 'classify': 'classification'}


class OnnxDetector:
    """
    Object detector with a YOLO network.

    Parameters
    ----------
    path
        The model file.
    labels_file
        A file with the names of the classes; '' for those in the model's metadata.
    layout
        One of `yolo.LAYOUTS`.
    input_size_px
        The longer edge of the input, for models with dynamic input size; 0 for the one in the
        model's metadata.
    threads
        The number of threads of the inference.

    Raises
    ------
    DetectorError
        The model cannot be used.

    """

    def __init__(
        self,
        path: str,
        labels_file: str = '',
        layout: str = AUTO,
        input_size_px: int = 0,
        threads: int = 1,
    ) -> None:
        self._path = path
        self._session = _session(path, threads)
        try:
            self._read(labels_file, layout, input_size_px)
        except DetectorError as error:
            raise DetectorError(f"The model '{path}' cannot be used. {error}") from None

    def _read(self, labels_file: str, layout: str, input_size_px: int) -> None:
        """Determine the input and the output layout of the model, by running it once."""
        metadata = dict(self._session.get_modelmeta().custom_metadata_map)
        _check_task(metadata)
        self._input, self._kind, self._scale = _input_of(self._session)
        self._fixed = _fixed_size(self._input.shape)
        imgsz = _sizes(metadata.get('imgsz', ''))
        self._longest_px = input_size_px or max(imgsz, default=_USUAL_SIZE_PX)
        self._stride_px = max(_sizes(metadata.get('stride', '')), default=_USUAL_STRIDE_PX)
        names = names_in_file(labels_file) if labels_file else _names(metadata.get('names', ''))
        height_px, width_px = self._fixed or (self._longest_px, self._longest_px)
        self._output = self._session.get_outputs()[0].name
        picture = np.full((height_px, width_px, 3), 114, dtype=np.uint8)
        shape = self._run(picture).shape
        count = len(names) if names else None
        self._layout, in_output = layout_of(shape, count, metadata, layout)
        if count is not None and self._layout != END_TO_END and count != in_output:
            raise DetectorError(_other_count(count, in_output, labels_file))
        self._names = names or [f'class_{number}' for number in range(in_output)]

    @property
    def title(self) -> str:
        """Return the display name of the detector: model, input size, layout and classes."""
        size = 'any size' if self._fixed is None else f'{self._fixed[1]}x{self._fixed[0]}'
        count = f'{len(self._names)} classes' if self._names else 'unnamed classes'
        return f"the model '{self._path}' ({size}, {self._layout}, {count})"

    @property
    def class_names(self) -> Sequence[str]:
        """Return the names of all classes, in the order of the network's outputs."""
        return tuple(self._names)

    @property
    def layout(self) -> str:
        """Return the layout of the output, one of `yolo.LAYOUTS`."""
        return self._layout

    def detect(
        self,
        color: Color,
        depth_m: Depth | None = None,
        focal_px: float = 0.0,
        confidence: float = 0.4,
        iou: float = 0.5,
    ) -> list[Detection]:
        """
        Detect objects with the network.

        Parameters
        ----------
        color, confidence, iou
            The image and the thresholds, as for `Detector.detect`. End-to-end networks suppress
            duplicates themselves, without `iou`.
        depth_m, focal_px
            Ignored.

        Returns
        -------
        list of Detection
            The detections, by decreasing score.

        Raises
        ------
        DetectorError
            The network cannot be run with an image of this size.

        """
        del depth_m, focal_px
        picture = color.shape[0], color.shape[1]
        size = self._fixed or letterbox_size(picture, self._longest_px, self._stride_px)
        letterbox = Letterbox.of(picture, size)
        output = self._run(letterbox.apply(color, size))
        found = candidates_in(output, self._layout, confidence)
        if self._layout != END_TO_END:
            found = suppressed(found, iou)
        boxes = letterbox.undo(found.boxes_px)
        detections = [
            Detection(
                self._name(int(number)),
                min(float(score), 1.0),
                box_of(row),
                is_cut(box_of(row), picture[1], picture[0]),
            )
            for row, score, number in zip(boxes, found.scores, found.classes)
            if row[2] - row[0] >= 1.0 and row[3] - row[1] >= 1.0
        ]
        return sorted(detections, key=lambda each: -each.score)

    def _name(self, number: int) -> str:
        return self._names[number] if number < len(self._names) else f'class_{number}'

    def _run(self, picture: Color) -> npt.NDArray[Any]:
        """Run the network on an input (height, width, 3); return its first output."""
        channels = np.ascontiguousarray(picture.transpose(2, 0, 1)[None])
        given = channels if self._kind is np.uint8 else channels.astype(self._kind)
        if self._scale != 1.0:
            given /= self._kind(self._scale)
        try:
            return np.asarray(self._session.run([self._output], {self._input.name: given})[0])
        except Exception as error:  # onnxruntime's errors share no other class
            raise DetectorError(
                f'onnxruntime cannot run it with an image of {picture.shape[1]} x '
                f'{picture.shape[0]} pixels: {_first_line(error)} Export it again, or set the '
                "parameter 'input_size' to the size that it was made for."
            ) from None


def names_in_file(path: str) -> list[str]:
    """
    Read class names from a labels file.

    Parameters
    ----------
    path
        A text file with one name per line; or, with the extension .yaml or .yml, a list, or a list
        or a table by number under `names`, as in YOLO data set files.

    Returns
    -------
    list of str
        The names in the order of the class numbers.

    Raises
    ------
    DetectorError
        The file cannot be read, or has no names.

    """
    try:
        text = expanded_path(path).read_text(encoding='utf-8')
        if path.endswith(('.yaml', '.yml')):
            content = yaml.safe_load(text)
            names = _listed(content.get('names') if isinstance(content, dict) else content)
        else:
            names = [line.strip() for line in text.splitlines() if line.strip()]
    except (OSError, ValueError, RecursionError, yaml.YAMLError) as error:
        raise DetectorError(
            f"The labels file '{path}' cannot be read: {_first_line(error)} Correct the parameter "
            "'labels_file', or leave it empty for the names in the model."
        ) from None
    if not names:
        raise DetectorError(
            f"The labels file '{path}' has no names. Give one per line, or a YAML list 'names'."
        )
    return names


def _session(path: str, threads: int) -> Any:
    """Create an inference session from a model file."""
    try:
        import onnxruntime
    except ImportError as error:
        raise DetectorError(
            f"The backend 'onnx' needs onnxruntime, which cannot be imported: {error}. "
            "Install that Python package, or set the parameter 'backend' to 'colour'."
        ) from None
    if not Path(path).is_file():
        raise DetectorError(
            f"Model file '{path}' not found. Correct the parameter 'model_path', or set the "
            "parameter 'backend' to 'colour', which needs none."
        )
    options = onnxruntime.SessionOptions()
    options.intra_op_num_threads = threads
    options.inter_op_num_threads = 1
    options.execution_mode = onnxruntime.ExecutionMode.ORT_SEQUENTIAL
    # Spinning threads would take CPU time from all other nodes.
    options.add_session_config_entry('session.intra_op.allow_spinning', '0')
    options.log_severity_level = 4
    try:
        return onnxruntime.InferenceSession(path, options, providers=['CPUExecutionProvider'])
    except Exception as error:  # onnxruntime's errors share no other class
        raise DetectorError(
            f"The model file '{path}' cannot be loaded: {_first_line(error)} It is truncated, not "
            'ONNX, or newer than the installed onnxruntime '
            f'({onnxruntime.__version__}). Copy or export it again.'
        ) from None


def _check_task(metadata: dict[str, str]) -> None:
    task = metadata.get('task', 'detect')
    if task != 'detect':
        raise DetectorError(
            f'It is made for {_TASKS.get(task, repr(task))}, not for detection. Export a '
            'detection model.'
        )


def _input_of(session: Any) -> tuple[Any, Any, float]:
    """Return the input of a model, its data type, and the divisor of pixel values."""
    inputs = session.get_inputs()
    kinds = ', '.join(f'{each.name} {each.type} {each.shape}' for each in inputs)
    shape = inputs[0].shape if inputs else []
    fits = (
        len(inputs) == 1
        and len(shape) == 4
        and (shape[1] == 3 or not isinstance(shape[1], int))
        and (shape[0] == 1 or not isinstance(shape[0], int))
    )
    if not fits or inputs[0].type not in _TYPES:
        raise DetectorError(
            f'It takes {kinds or "nothing"}, but a detector takes one image: [1, 3, height, '
            'width] of float32, float16 or uint8. Export it for a single image, channels first.'
        )
    return (inputs[0], *_TYPES[inputs[0].type])


def _fixed_size(shape: Sequence[Any]) -> tuple[int, int] | None:
    """Return the input height and width of a model; None if they are dynamic."""
    height, width = shape[2:]
    if isinstance(height, int) and isinstance(width, int) and min(height, width) > 0:
        return height, width
    return None


def _sizes(text: str) -> list[int]:
    """Parse integers from metadata, such as '[640, 640]' or '32'."""
    try:
        value = ast.literal_eval(text) if text else []
    except (ValueError, SyntaxError, MemoryError, RecursionError):
        return []
    values = value if isinstance(value, (list, tuple)) else [value]
    return [each for each in values if isinstance(each, int) and 0 < each <= _LARGEST_PX]


def _names(text: str) -> list[str]:
    """Parse class names from metadata, a Python literal; [] if there are none."""
    try:
        return _listed(ast.literal_eval(text)) if text else []
    except (ValueError, SyntaxError, MemoryError, RecursionError):
        return []


def _listed(names: Any) -> list[str]:
    """Convert class names, as a list or a table by number, to a list."""
    if isinstance(names, (list, tuple)):
        return [str(name) for name in names]
    if isinstance(names, dict):
        try:
            numbers = {int(number): str(name) for number, name in names.items()}
        except (TypeError, ValueError):
            return []
        if 0 <= min(numbers, default=0) and max(numbers, default=0) < 100_000:
            most = max(numbers, default=-1)
            return [numbers.get(number, f'class_{number}') for number in range(most + 1)]
    return []


def _other_count(known: int, in_output: int, labels_file: str) -> str:
    source = f"The labels file '{labels_file}'" if labels_file else 'Its metadata'
    return (
        f'{source} names {known} classes, but its output has {in_output}. Set the parameter '
        "'labels_file' to a file of the names that it was trained with."
    )


def _first_line(error: Exception) -> str:
    """Return the first line of an error message, ending with a full stop."""
    lines = str(error).strip().splitlines()
    text = ' '.join(lines[0].split())[:200] if lines else type(error).__name__
    return text.rstrip('.') + '.'
