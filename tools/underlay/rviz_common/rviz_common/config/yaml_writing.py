# SPDX-License-Identifier: Apache-2.0
"""Write YAML in the style of RViz."""

from __future__ import annotations

from typing import Any

from rviz_common.config.yaml_reading import scalar_value
import yaml

__all__ = ['write_yaml']


def write_yaml(values: Any) -> str:
    """
    Format values as YAML in the style of RViz.

    Parameters
    ----------
    values
        Nested dicts and lists of scalars.

    """
    text: str = yaml.dump(
        values,
        Dumper=_Dumper,
        default_flow_style=False,
        sort_keys=False,
        allow_unicode=True,
        width=1_000_000,
    )
    return text


class _Dumper(yaml.SafeDumper):
    """Indents lists as RViz does; all scalars are strings, some of them unquoted."""

    yaml_implicit_resolvers: dict[Any, Any] = {}

    def increase_indent(self, flow: bool = False, indentless: bool = False) -> None:
        """Indent lists below their keys, too."""
        super().increase_indent(flow, False)

    def ignore_aliases(self, data: Any) -> bool:
        """Write repeated values in full, without aliases."""
        return True


def _scalar(dumper: yaml.SafeDumper, text: str, style: str | None = None) -> yaml.Node:
    return dumper.represent_scalar('tag:yaml.org,2002:str', text, style)


def _text(dumper: yaml.SafeDumper, text: str) -> yaml.Node:
    """Quote strings that would be read as another type."""
    return _scalar(dumper, text, None if isinstance(scalar_value(text), str) else '"')


_Dumper.add_representer(str, _text)
_Dumper.add_representer(bool, lambda dumper, value: _scalar(dumper, str(value).lower()))
_Dumper.add_representer(int, lambda dumper, value: _scalar(dumper, str(value)))
_Dumper.add_representer(float, lambda dumper, value: _scalar(dumper, repr(value)))
_Dumper.add_representer(type(None), lambda dumper, value: _scalar(dumper, '~'))
