# SPDX-License-Identifier: Apache-2.0
"""Each kind of error is told in short, with file, line and cause."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
import re

import pytest
from xacro_program import main

HEAD = '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
LIBRARY = f"""<?xml version="1.0"?>
{HEAD}
  <xacro:property name="half" value="${{1 / 0}}"/>
  <xacro:property name="length" value="2"/>
  <xacro:arg name="side" default="left"/>
  <xacro:macro name="leg" params="side size:=1">
    <link name="${{side}}"
          size="${{size * 2}}"/>
  </xacro:macro>
  <xacro:macro name="around" params="*block">
    <xacro:insert_block name="block"/>
  </xacro:macro>
  <xacro:macro name="late" params="a:=${{unknown_default}}"/>
  <xacro:macro name="halved" params="">
    <mass value="${{half}}"/>
  </xacro:macro>
</robot>
"""
# The content of line 4 of the file, where the error is told, and the text.
ERRORS = {
    'symbol': (
        '<a x="${lenght * 2}"/>',
        "top.xacro:4:7: error: in ${lenght * 2}: name 'lenght' is not defined. "
        "Did you mean 'length'?",
    ),
    'symbol in a text': (
        '<a><b/>\n  ${lenght}</a>',
        "top.xacro:5:3: error: in ${lenght}: name 'lenght' is not defined. Did you mean 'length'?",
    ),
    'symbol on a later line': (
        '<a\n  x="1"\n  y="a ${lenght}"/>',
        "top.xacro:6:8: error: in ${lenght}: name 'lenght' is not defined. Did you mean 'length'?",
    ),
    'symbol in a property': (
        '<xacro:property name="a" value="${lenght}"/>\n<xacro:property name="b" value="${a}"/>\n'
        '<a x="${b}"/>',
        "top.xacro:4:33: error: in ${lenght}: name 'lenght' is not defined. "
        "Did you mean 'length'?\n"
        "  in property 'a', used at top.xacro:5\n"
        "  in property 'b', used at top.xacro:6",
    ),
    'division by zero': (
        '<a x="${half}"/>',
        'lib.xacro:4:38: error: in ${1 / 0}: division by zero\n'
        "  in property 'half', used at top.xacro:4",
    ),
    'in a macro': (
        '<xacro:halved/>',
        'lib.xacro:4:38: error: in ${1 / 0}: division by zero\n'
        "  in property 'half', used at lib.xacro:16\n"
        "  in macro 'halved', called at top.xacro:4",
    ),
    'value of another type': (
        '<a>\n<xacro:leg side="l" size="${[]}"/>\n</a>\n<xacro:leg side="r" size="${{}"/>',
        "top.xacro:7:27: error: in ${{}: '{' was never closed. An expression ends at the first }: "
        'write dict(a=1) for {...}',
    ),
    'type of a parameter': (
        '<xacro:leg side="l" size="${dict(a=1)}"/>',
        'lib.xacro:9:17: error: in ${size * 2}: TypeError: unsupported operand type(s) for *: '
        "'dict' and 'int'\n  in macro 'leg', called at top.xacro:4",
    ),
    'macro': (
        '<xacro:legg side="l"/>',
        "top.xacro:4:1: error: unknown macro name: xacro:legg. Did you mean 'xacro:leg'?",
    ),
    'tag of xacro': (
        '<xacro:propety name="a" value="1"/>',
        "top.xacro:4:1: error: unknown macro name: xacro:propety. Did you mean 'xacro:property'?",
    ),
    'missing parameter': (
        '\n  <xacro:leg size="1"/>',
        "top.xacro:5:3: error: Undefined parameters [side]. The macro 'leg' needs: side",
    ),
    'misspelt parameter': (
        '<xacro:leg syde="l"/>',
        'top.xacro:4:1: error: Invalid parameter "syde". Did you mean \'side\'?',
    ),
    'default of a parameter': (
        '<xacro:late/>',
        'lib.xacro:14:39: error: in ${unknown_default}: '
        "name 'unknown_default' is not defined\n  in macro 'late', called at top.xacro:4",
    ),
    'missing block': (
        '<xacro:around/>',
        "top.xacro:4:1: error: Not enough blocks. The macro 'around' takes as child elements: "
        '*block',
    ),
    'unused block': (
        '<xacro:leg side="l"><a/></xacro:leg>',
        'top.xacro:4:1: error: Unused block "a". '
        "The macro 'leg' takes as child elements: nothing",
    ),
    'inside a block': (
        '<xacro:around>\n  <a>\n    <b x="${1 +}"/></a>\n</xacro:around>',
        'top.xacro:6:11: error: in ${1 +}: invalid syntax',
    ),
    'undefined block': (
        '<xacro:insert_block name="b"/>',
        'top.xacro:4:1: error: Undefined block "b"',
    ),
    'argument': (
        '<a x="$(arg sied)"/>',
        "top.xacro:4:7: error: in $(arg sied): the argument 'sied' is neither declared nor given. "
        "Did you mean 'side'?",
    ),
    'argument like no other': (
        '<a x="$(arg weight)"/>',
        "top.xacro:4:7: error: in $(arg weight): the argument 'weight' is neither declared nor "
        'given. Declare it: <xacro:arg name="weight" default="..."/>',
    ),
    'environment': (
        '<a x="$(env NO_SUCH_VARIABLE)"/>',
        'top.xacro:4:7: error: in $(env NO_SUCH_VARIABLE): '
        "environment variable 'NO_SUCH_VARIABLE' is not set",
    ),
    'missing include': (
        '<a>\n  <xacro:include filename="libb.xacro"/></a>',
        "top.xacro:5:3: error: the file 'libb.xacro' does not exist. Did you mean 'lib.xacro'?",
    ),
    'broken include': (
        '<xacro:include filename="broken.xacro"/>',
        'broken.xacro:3:5: error: broken XML: mismatched tag; <link> of line 2 is still open\n'
        '  included at top.xacro:4',
    ),
    'missing attribute': (
        '<xacro:property value="a"/>',
        "top.xacro:4:1: error: xacro:property: missing attribute 'name'",
    ),
    'condition': (
        '<xacro:if value="maybe"/>',
        'top.xacro:4:1: error: Xacro conditional "maybe" evaluated to "maybe", which is not a '
        'boolean expression',
    ),
    'circle': (
        '<xacro:property name="a" value="${b}"/><xacro:property name="b" value="${a}"/>\n'
        '<a x="${a}"/>',
        'top.xacro:4:72: error: in ${a}: circular variable definition: a -> b -> a, Consider '
        'disabling lazy evaluation via lazy_eval="false"\n'
        "  in property 'b', used at top.xacro:4\n  in property 'a', used at top.xacro:5",
    ),
    'missing YAML': (
        '<a x="${xacro.load_yaml(\'values.yml\')}"/>',
        "top.xacro:4:7: error: in ${xacro.load_yaml('values.yml')}: the file 'values.yml' does "
        "not exist. Did you mean 'values.yaml'?",
    ),
    "a file's own complaint": (
        '<a x="${xacro.fatal(\'too small\')}"/>',
        'top.xacro:4:7: error: too small',
    ),
    'prefix of XML': (
        '<a q:x="1"/>',
        'top.xacro:4:1: error: broken XML: unbound prefix. Declare the prefix before '
        'the colon in the first element: xmlns:xacro="http://www.ros.org/wiki/xacro"',
    ),
    'XML': (
        '<a>\n  <b></a>',
        'top.xacro:5:8: error: broken XML: mismatched tag; <b> of line 5 is still open',
    ),
}
Run = Callable[..., 'tuple[int, str, str]']


@pytest.fixture
def run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Run:
    """Return a function that expands a top.xacro, whose fourth line it is given."""
    monkeypatch.chdir(tmp_path)
    Path('lib.xacro').write_text(LIBRARY)
    Path('values.yaml').write_text('a: 1')
    Path('broken.xacro').write_text(f'{HEAD}<link>\n  </robot>')

    def run(content: str, *arguments: str) -> tuple[int, str, str]:
        text = f'{HEAD}<xacro:include filename="lib.xacro"/>\n\n{content}\n</robot>\n'
        Path('top.xacro').write_text(text)
        status = main(['top.xacro', *arguments])
        return status, *capsys.readouterr()

    return run


@pytest.mark.parametrize('kind', ERRORS)
def test_error(kind: str, run: Run) -> None:
    """An error is told with file, line, column, cause and the way there; nothing is written."""
    content, text = ERRORS[kind]
    assert run(content) == (1, '', f'{text}\n')


def test_missing_package(run: Run) -> None:
    """A package that is not there is told with the line of the include that names it."""
    status, out, err = run('<xacro:include filename="$(find xacroo)/a.xacro"/>')
    assert (status, out) == (1, '')
    assert err.startswith(
        "top.xacro:4:26: error: in $(find xacroo): there is no package 'xacroo'. "
    )
    assert err.endswith("Did you mean 'xacro'?\n")
    assert len(err.splitlines()) == 1


def test_include_of_itself(run: Run) -> None:
    """A file that includes itself is told once, with the line of the include."""
    status, out, err = run('<xacro:include filename="top.xacro"/>')
    assert (status, out) == (1, '')
    lines = err.splitlines()
    assert lines[0].endswith(': error: infinite recursion of macros or includes')
    assert lines[1:] == ['  included at top.xacro:4']


@pytest.mark.parametrize(
    ('arguments', 'text'),
    [
        (['topp.xacro'], r"topp\.xacro: error: the file 'topp\.xacro' does not exist\. .*"),
        (['.'], r"\.: error: '\.' cannot be read: Is a directory"),
        (['empty.xacro'], r'empty\.xacro:1:1: error: broken XML: no element found'),
    ],
)
def test_input_file(
    arguments: list[str], text: str, run: Run, capsys: pytest.CaptureFixture[str]
) -> None:
    """A file that cannot be read is told in one line."""
    Path('empty.xacro').touch()
    assert main(arguments) == 1
    out, err = capsys.readouterr()
    assert out == ''
    assert re.fullmatch(text + '\n', err)


def test_traceback_on_request(run: Run) -> None:
    """-v adds the traceback."""
    status, _, err = run('<a x="${b}"/>', '-v')
    assert status == 1
    assert err.startswith("top.xacro:4:7: error: in ${b}: name 'b' is not defined")
    assert 'Traceback (most recent call last)' in err
