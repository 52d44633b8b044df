# SPDX-License-Identifier: Apache-2.0
"""Tags, substitutions and formats of other packages."""

from __future__ import annotations

from collections.abc import Iterator
from importlib.metadata import EntryPoint
import io
from typing import Any, List  # noqa: UP035

from launch import Action, LaunchContext, Substitution
from launch.actions import LogInfo
from launch.frontend import (
    Entity,
    expose,
    expose_action,
    expose_substitution,
    InvalidFrontendLaunchFileError,
    Parser,
)
from launch.frontend.expose import known_actions, load
from launch.frontend.parse_substitution import parse_substitution
from launch.frontend.type_utils import check_is_list_entity, get_data_type_from_identifier
from launch.utilities import perform_substitutions
import pytest


class Dictionary(Entity):
    """An element that is made of a dictionary."""

    def __init__(self, type_name: str, content: dict[str, Any]) -> None:
        """Create the element."""
        super().__init__(type_name)
        self._content = content

    @property
    def children(self) -> list[Entity]:
        """Return what is in the element."""
        return list(self._content.get('children', []))

    def _value(self, name: str, data_type: Any, can_be_str: bool) -> Any:
        return self._content.get(name)

    def _children_of_type(self, name: str) -> list[Entity]:
        return [Dictionary(name, each) for each in self._content.get(name, [])]

    def _left(self) -> list[tuple[str, list[str]]]:
        return [('key(s)', [name for name in self._content if name not in self._asked_names()])]

    def _asked_names(self) -> list[str]:
        return list(vars(self)['_Entity__asked'])


@pytest.fixture(autouse=True)
def _own_names() -> Iterator[None]:
    """Forget what a test has exposed."""
    actions = dict(expose.action_parse_methods)
    substitutions = dict(expose.substitution_parse_methods)
    expose.load_extensions.cache_clear()
    expose.extension_parsers.cache_clear()
    yield
    expose.action_parse_methods.clear()
    expose.action_parse_methods.update(actions)
    expose.substitution_parse_methods.clear()
    expose.substitution_parse_methods.update(substitutions)
    expose.load_extensions.cache_clear()
    expose.extension_parsers.cache_clear()


def _offer(monkeypatch: pytest.MonkeyPatch, group: str, value: str) -> None:
    """Let an entry point be there."""
    points = [EntryPoint(name='mine', value=value, group=group)]
    monkeypatch.setattr(
        'launch.frontend.expose.entry_points_of',
        lambda wanted: points if wanted == group else [],
    )


def test_action_of_another_package() -> None:
    """An exposed action extends what its base class parses."""

    @expose_action('shout')
    class Shout(Action):
        def __init__(self, text: Any, **kwargs: Any) -> None:
            super().__init__(**kwargs)
            self.text = text

        @classmethod
        def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
            _, kwargs = super().parse(entity, parser)
            kwargs['text'] = parser.parse_substitution(entity.get_attr('text'))
            return cls, kwargs

    action = Parser().parse_action(Dictionary('shout', {'text': 'x', 'if': 'true'}))
    assert isinstance(action, Shout)
    assert action.condition is not None
    assert perform_substitutions(LaunchContext(), action.text) == 'x'


def test_function_as_action() -> None:
    """A function that returns a class and its arguments can be exposed, too."""

    @expose_action('greet')
    def parse(entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        return LogInfo, {'msg': 'hello'}

    assert isinstance(Parser().parse_action(Dictionary('greet', {})), LogInfo)


def test_substitution_of_another_package() -> None:
    """An exposed substitution gets its arguments as lists of substitutions."""

    @expose_substitution('twice')
    class Twice(Substitution):
        def __init__(self, text: list[Substitution]) -> None:
            self.text = text

        @classmethod
        def parse(cls, data: Any) -> tuple[Any, dict[str, Any]]:
            return cls, {'text': data[0]}

        def perform(self, context: LaunchContext) -> str:
            return 2 * perform_substitutions(context, self.text)

    assert perform_substitutions(LaunchContext(), parse_substitution('$(twice ab)')) == 'abab'


def test_names_are_unique() -> None:
    """A name that is taken cannot be exposed again for something else."""
    expose_action('mine')(LogInfo)
    expose_action('mine')(LogInfo)
    with pytest.raises(RuntimeError, match="under the name 'mine'"):
        expose_action('mine')(Action)
    with pytest.raises(RuntimeError, match="under the name 'log'"):
        expose_action('log')(Action)


def test_what_cannot_be_exposed() -> None:
    """A class without parse() is refused."""
    with pytest.raises(RuntimeError, match="no method 'parse'"):
        expose_action('mine')(int)


def test_extension(monkeypatch: pytest.MonkeyPatch) -> None:
    """A tag that is not known is looked for in the packages that offer extensions."""
    monkeypatch.setattr(EntryPoint, 'load', lambda self: expose_action('offered')(LogInfo))
    _offer(monkeypatch, 'launch.frontend.launch_extension', 'some.module')
    assert isinstance(Parser().parse_action(Dictionary('offered', {'message': 'x'})), LogInfo)


def test_extension_that_cannot_be_loaded(monkeypatch: pytest.MonkeyPatch) -> None:
    """An extension that fails is warned about; the tag stays unknown."""
    _offer(monkeypatch, 'launch.frontend.launch_extension', 'no_such_module')
    with (
        pytest.warns(UserWarning, match=r"'mine' \(no_such_module\) of the group"),
        pytest.raises(
            RuntimeError, match='^Unrecognized entity of the type: lgo\nDid you mean .log'
        ),
    ):
        Parser().parse_action(Dictionary('lgo', {}))


def test_format_of_another_package(monkeypatch: pytest.MonkeyPatch) -> None:
    """A parser that a package offers is asked if none of the others accepts the file."""

    class Words(Parser):
        @classmethod
        def load(cls, file: Any) -> tuple[Entity, Parser]:
            assert file.read() == 'words: [of mine'
            return Dictionary('launch', {'children': [Dictionary('log', {'message': 'x'})]}), cls()

    monkeypatch.setattr(EntryPoint, 'load', lambda self: Words)
    _offer(monkeypatch, 'launch.frontend.parser', 'words')
    root, parser = Parser.load(io.StringIO('words: [of mine'))
    [action] = parser.parse_description(root).entities
    assert isinstance(action, LogInfo)


def test_nobody_accepts_the_file(monkeypatch: pytest.MonkeyPatch) -> None:
    """A file that no parser accepts has an unknown format."""
    with pytest.raises(InvalidFrontendLaunchFileError, match='syntax error, or its format is'):
        Parser.load(io.StringIO('words: [of mine'))


def test_every_known_tag_can_be_loaded() -> None:
    """Each place in the table has a class with parse()."""
    for place in known_actions().values():
        assert callable(load(place).parse)


def test_types() -> None:
    """Types have names in launch files; lists of entities are told from other lists."""
    assert check_is_list_entity(List[Entity])  # noqa: UP006
    assert check_is_list_entity(list[Dictionary])
    assert not check_is_list_entity(list[str])
    assert not check_is_list_entity(str)
    assert get_data_type_from_identifier('float') is float
    assert get_data_type_from_identifier('list_of_ints') == list[int]
    assert get_data_type_from_identifier('yaml') is None
    with pytest.raises(ValueError, match="unknown type 'text': expected one of bool"):
        get_data_type_from_identifier('text')
