# SPDX-License-Identifier: Apache-2.0
"""Parameters of the node `object_detector`, and the detector that they select."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from ament_index_python.packages import get_package_share_directory
from humanoid_common.parameters import parameter
from humanoid_common.paths import expanded_path
from humanoid_perception.colour_backend import ColourDetector
from humanoid_perception.detection import Detector
from humanoid_perception.onnx_backend import OnnxDetector
from humanoid_perception.yolo import AUTO, LAYOUTS

__all__ = ['BEST_EFFORT', 'RELIABLE', 'DetectorParameters', 'make_detector']

ONNX, COLOUR = 'onnx', 'colour'
RELIABLE, BEST_EFFORT = 'reliable', 'best_effort'
DEFAULT_MODEL = 'apartment_things.onnx'


@dataclass(frozen=True)
class DetectorParameters:
    """The parameters of the node."""

    backend: str = parameter(
        ONNX,
        'The detector: a YOLO network (onnx), or colours and shapes without a network (colour).',
        choices=(ONNX, COLOUR),
        read_only=True,
    )
    model_path: str = parameter(
        '', 'The ONNX file of a YOLO network; empty for the one in this package.', read_only=True
    )
    labels_file: str = parameter(
        '',
        'Class names, one per line or as YAML; empty for the names in the model.',
        read_only=True,
    )
    layout: str = parameter(
        AUTO, 'The output layout of the network.', choices=LAYOUTS, read_only=True
    )
    input_size: int = parameter(
        0,
        'The longer edge of the network input, for networks that accept any size; 0 for the '
        'size that the model declares (pixels).',
        at_least=0,
        at_most=4096,
        read_only=True,
    )
    num_threads: int = parameter(
        1, 'Number of inference threads.', at_least=1, at_most=64, read_only=True
    )
    confidence: float = parameter(
        0.5, 'Minimum score of a detection.', at_least=0.001, at_most=1.0
    )
    iou: float = parameter(
        0.5,
        'Largest overlap of two detections of a class, as intersection over union.',
        at_least=0.0,
        at_most=1.0,
    )
    max_rate_hz: float = parameter(
        5.0,
        'Maximum rate of processed images, by their stamps (Hz).',
        at_least=0.01,
        at_most=1000.0,
    )
    max_depth_offset_s: float = parameter(
        0.02,
        'Largest difference between the stamps of a depth image and its colour image (s).',
        at_least=0.0,
        at_most=1.0,
    )
    target_frame: str = parameter(
        'odom',
        'The frame of 3-D detections, whose z axis points up; empty for the camera frame.',
    )
    image_reliability: str = parameter(
        AUTO,
        'Reliability of the image subscription; auto starts with reliable, then adapts.',
        choices=(AUTO, RELIABLE, BEST_EFFORT),
        read_only=True,
    )


def make_detector(told: DetectorParameters) -> Detector:
    """
    Create the detector that the parameters select.

    Parameters
    ----------
    told
        The parameters of the node.

    Raises
    ------
    DetectorError
        Its model cannot be loaded or used.
    UserError
        The path of the model begins with a home folder that does not exist.

    """
    if told.backend == COLOUR:
        return ColourDetector()
    share = Path(get_package_share_directory('humanoid_perception'))
    path = str(expanded_path(told.model_path)) if told.model_path else ''
    return OnnxDetector(
        path or str(share / 'models' / DEFAULT_MODEL),
        told.labels_file,
        told.layout,
        told.input_size,
        told.num_threads,
    )
