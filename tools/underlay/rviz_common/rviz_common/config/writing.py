# SPDX-License-Identifier: Apache-2.0
"""How a .rviz file is written: as YAML in the style of RViz, and atomically."""

from __future__ import annotations

from contextlib import suppress
import os
import stat
import tempfile
from typing import Any

from rviz_common.config.reading import ConfigError, scalar_value
import yaml

__all__ = ['replace_file', 'write_yaml']


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


def replace_file(path: str, text: str) -> None:
    """
    Replace the contents of a file atomically, preserving its permissions.

    Parameters
    ----------
    path
        The file. If it is a symbolic link, its target is replaced.
    text
        The new contents, written as UTF-8.

    Raises
    ------
    ConfigError
        The file cannot be written; it is left unchanged.

    """
    path = os.path.realpath(path)  # the target of a link, not the link itself
    try:
        _replace(path, text.encode())
    except OSError as error:
        raise ConfigError(
            path, None, f'The file cannot be written: {error.strerror}. It is unchanged.'
        ) from error


def _replace(path: str, content: bytes) -> None:
    directory, name = os.path.split(path)
    handle, temporary = tempfile.mkstemp(prefix=f'.{name}.', dir=directory)
    try:
        with open(handle, 'wb') as file:
            os.fchmod(handle, _mode(path))
            file.write(content)
            file.flush()
            os.fsync(handle)
        os.replace(temporary, path)
    except BaseException:
        with suppress(OSError):
            os.unlink(temporary)
        raise


def _mode(path: str) -> int:
    """Return the permissions of the existing file, or those of a new one."""
    with suppress(OSError):
        return stat.S_IMODE(os.stat(path).st_mode)
    mask = os.umask(0)
    os.umask(mask)
    return 0o666 & ~mask
