#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""
Measure a detector on pictures that it was never trained on, by class, distance and renderer.

It runs as it does on the robot, by onnxruntime. The tables are written as Markdown; with --card
they replace those of the model card.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
import time

from batches import letterboxed
from boxes import corners, suppressed
from export import MODEL
from metrics import Counted, Detections, mean_average_precision, quality
import numpy as np
import onnxruntime
import pictures
from pictures import CLASSES, GL, Labels, RAYS
from train import DATA

COUNTED = Counted()
DISTANCES_M = ((0.3, 0.5), (0.5, 1.0), (1.0, 1.5), (1.5, 2.0), (2.0, 2.5), (2.5, 3.0), (3.0, 4.0))
SCORE = 0.4
"""That above which precision and recall are told."""
_LEAST_SCORE, _MOST_IOU = 0.03, 0.6


def main() -> None:
    """Print the tables, and write them if a file is named."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--data', type=Path, default=DATA, help='the folder of the pictures')
    parser.add_argument('--part', default='test', help='which pictures: test, apartment, ...')
    parser.add_argument('--model', type=Path, default=MODEL)
    parser.add_argument('--card', action='store_true', help='write the tables to the model card')
    arguments = parser.parse_args()
    shards = list(pictures.shards(arguments.data / arguments.part))
    if not shards:
        parser.error(f'{arguments.data / arguments.part} has no pictures. Run render.py first.')
    evaluation = detected(arguments.model, shards)
    text = '\n'.join(evaluation.report())
    print(text)
    if arguments.card:
        write_card(arguments.model.with_name('README.md'), arguments.part, text)


def write_card(card: Path, part: str, text: str) -> None:
    """
    Replace the results of a part in a model card, between its comments.

    Parameters
    ----------
    card
        The file of the model card.
    part
        The part of the pictures, such as `test`.
    text
        The new results, in Markdown.

    Raises
    ------
    SystemExit
        The card has no comments for this part.

    """
    mark, end = f'<!-- results: {part} -->\n', '<!-- end -->'
    before, found, rest = card.read_text(encoding='utf-8').partition(mark)
    if not found or end not in rest:
        raise SystemExit(f'{card} has no place for these results: no lines {mark.strip()}, {end}.')
    after = rest[rest.index(end) :]
    card.write_text(f'{before}{mark}\n{text}\n\n{after}', encoding='utf-8')


@dataclass(frozen=True)
class Evaluation:
    """What is visible in some pictures, and what was detected there."""

    truth: Sequence[Labels]
    found: Sequence[Detections]
    renderers: Sequence[int]
    milliseconds: float
    """Processor time of the network for a picture."""

    def report(self) -> Iterator[str]:
        """Yield the lines of the tables."""
        kinds = range(len(CLASSES))
        every = [quality(self.truth, self.found, kind, COUNTED, score=SCORE) for kind in kinds]
        strict = [quality(self.truth, self.found, kind, COUNTED, 0.75) for kind in kinds]
        yield f'{len(self.truth)} pictures, {self.milliseconds:.1f} ms of processor time each.'
        yield ''
        yield f'| class | things | AP50 | AP75 | precision at {SCORE} | recall at {SCORE} |'
        yield '|---|---|---|---|---|---|'
        for kind, each, exact in zip(CLASSES, every, strict):
            yield (
                f'| {kind} | {each.things} | {each.average_precision:.3f} | '
                f'{exact.average_precision:.3f} | {each.precision:.3f} | {each.recall:.3f} |'
            )
        yield (
            f'| **all** | {sum(each.things for each in every)} | '
            f'**{mean_average_precision(every):.3f}** | {mean_average_precision(strict):.3f} | '
            f'{np.nanmean([each.precision for each in every]):.3f} | '
            f'{np.nanmean([each.recall for each in every]):.3f} |'
        )
        yield ''
        yield f'| distance | things | found at {SCORE} |'
        yield '|---|---|---|'
        for nearest_m, farthest_m in DISTANCES_M:
            limits = replace(COUNTED, nearest_m=nearest_m, farthest_m=farthest_m)
            there = [quality(self.truth, self.found, kind, limits, score=SCORE) for kind in kinds]
            things = sum(one.things for one in there)
            hits = sum(round(one.recall * one.things) for one in there if one.things)
            found = f'{100 * hits / things:.0f} %' if things else ''
            yield f'| {nearest_m:g} to {farthest_m:g} m | {things} | {found} |'
        yield ''
        yield '| of these | things | mAP50 |'
        yield '|---|---|---|'
        everything = range(len(self.truth))
        yield self._row('60 % visible', replace(COUNTED, visible=0.6), everything)
        yield self._row('8 pixels wide and high, about', replace(COUNTED, pixels=64), everything)
        few = replace(COUNTED, visible=0.1, pixels=1)
        yield self._row('10 % visible, any size', few, everything)
        for name, renderer in (('by OpenGL', GL), ('by rays', RAYS)):
            chosen = [n for n, each in enumerate(self.renderers) if each == renderer]
            yield self._row(name, COUNTED, chosen)
        empty = [n for n, labels in enumerate(self.truth) if len(labels) == 0]
        wrong = sum(int((self.found[n][2] >= SCORE).sum()) for n in empty)
        yield ''
        yield f'In {len(empty)} pictures that show no thing at all: {wrong} detections.'

    def _row(self, name: str, counted: Counted, chosen: Sequence[int]) -> str:
        """Return a row for some of the things, in some of the pictures."""
        truth = [self.truth[number] for number in chosen]
        found = [self.found[number] for number in chosen]
        each = [quality(truth, found, kind, counted) for kind in range(len(CLASSES))]
        things = sum(one.things for one in each)
        return f'| {name} | {things} | {mean_average_precision(each):.3f} |'


def detected(path: Path, shards: Sequence[pictures.Shard]) -> Evaluation:
    """
    Run a model on all pictures.

    Parameters
    ----------
    path
        The ONNX file of the model.
    shards
        The pictures, one at least.

    """
    session = _session(path)
    name = session.get_inputs()[0].name
    truth: list[Labels] = []
    found: list[Detections] = []
    renderers: list[int] = []
    spent_s = 0.0
    for shard in shards:
        for color, labels, renderer in zip(shard.colors, shard.labels, shard.renderers):
            picture, rows = letterboxed(color)
            batch = picture.transpose(2, 0, 1)[None].astype(np.float32) / 255.0
            started_s = time.process_time()
            output = session.run(None, {name: batch})[0][0].T
            spent_s += time.process_time() - started_s
            boxes = corners(output[:, :4]) - np.array([0, rows, 0, rows], np.float32)
            found.append(suppressed(boxes, output[:, 4:], _LEAST_SCORE, _MOST_IOU))
            truth.append(labels)
            renderers.append(int(renderer))
    return Evaluation(truth, found, renderers, 1e3 * spent_s / len(truth))


def _session(path: Path) -> onnxruntime.InferenceSession:
    """Load a model for one thread."""
    options = onnxruntime.SessionOptions()
    options.intra_op_num_threads = options.inter_op_num_threads = 1
    return onnxruntime.InferenceSession(str(path), options, providers=['CPUExecutionProvider'])


if __name__ == '__main__':
    main()
