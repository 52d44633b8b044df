# SPDX-License-Identifier: Apache-2.0
"""Read YAML into lists and dictionaries that know the lines on which they begin."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Union

import yaml

_Base: Any = getattr(yaml, 'CSafeLoader', yaml.SafeLoader)


class Mapping(dict[Any, Any]):
    """A dictionary with the line on which it begins."""

    line = 1


class Sequence(list[Any]):
    """A list with the line on which it begins."""

    line = 1


class NotYAMLError(Exception):
    """A text is not YAML; the error knows the line."""

    def __init__(self, error: yaml.YAMLError) -> None:
        """Create the error from what PyYAML found."""
        super().__init__(str(error))
        mark = getattr(error, 'problem_mark', None)
        self.line = 1 if mark is None else mark.line + 1


class _Loader(_Base):
    """A safe loader whose lists and dictionaries know their lines."""

    def _mapping(self, node: yaml.MappingNode) -> Iterator[Mapping]:
        mapping = Mapping()
        mapping.line = node.start_mark.line + 1
        yield mapping
        mapping.update(self.construct_mapping(node, deep=True))

    def _sequence(self, node: yaml.SequenceNode) -> Iterator[Sequence]:
        sequence = Sequence()
        sequence.line = node.start_mark.line + 1
        yield sequence
        sequence.extend(self.construct_sequence(node, deep=True))


_Loader.add_constructor('tag:yaml.org,2002:map', _Loader._mapping)
_Loader.add_constructor('tag:yaml.org,2002:seq', _Loader._sequence)


def read_document(content: Union[str, bytes]) -> Any:
    """
    Read a YAML document whose lists and dictionaries know their lines.

    Parameters
    ----------
    content
        The text of the document.

    Returns
    -------
    Any
        Nested Mapping and Sequence with scalars in them; None if it is empty.

    Raises
    ------
    NotYAMLError
        The text is not YAML.

    """
    try:
        return yaml.load(content, Loader=_Loader)  # noqa: S506
    except yaml.YAMLError as error:
        raise NotYAMLError(error) from None
