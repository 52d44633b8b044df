# SPDX-License-Identifier: Apache-2.0
"""Launch action for ROS nodes."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, Optional, TYPE_CHECKING

from launch.descriptions.executable import SomeVariables
from launch.launch_context import LaunchContext
from launch.launch_description_entity import LaunchDescriptionEntity
from launch.substitution import SomeSubstitutionsType, Substitution
from launch.utilities.arguments import list_like, optional_text_like, text_like
from launch_ros.actions._node_element import NodeElement
from launch_ros.actions._ros_arguments import (
    extend_node,
    global_arguments,
    NodeActionExtension,
    own_parameters,
    parameter_arguments,
    ParameterArgument,
    remap_pairs,
    remap_rules,
    rule_arguments,
)
from launch_ros.substitutions.find_package import ExecutableInPackage
from launch_ros.utilities.node_names import expand_node_names, NodeNames, warn_of_same_names
from launch_ros.utilities.parameters_and_remappings import (
    normalize_parameters,
    normalize_remap_rules,
)

if TYPE_CHECKING:
    from launch.launch_run import VisitObserver

__all__ = ['Node', 'NodeActionExtension']


class Node(NodeElement):
    """
    Runs an executable with the arguments that ROS nodes understand.

    Parameters
    ----------
    executable
        The name of the executable in the package, or a path if no package is given.
    package
        The package that installs the executable.
    name
        The node name; by default that of the executable.
    namespace
        The namespace, relative to that of PushROSNamespace unless it is absolute.
    exec_name
        The label of the process in the log; by default the program name.
    parameters : Optional[list[Any]]
        Dictionaries, paths of parameter files, ParameterFile and Parameter.
    remappings
        Tuples of the original and the new name.
    ros_arguments
        Additional ROS arguments, such as `--log-level`, `debug`.
    arguments : Optional[Iterable[SomeSubstitutionsType]]
        Arguments of the node itself, which precede the ROS arguments.
    prefix, cwd, env, additional_env
        As for `ExecuteProcess`.
    **kwargs
        Additional arguments of `ExecuteProcess`, such as `output` and `respawn`.

    Raises
    ------
    TypeError
        An argument has the wrong type, such as a string instead of a list.

    """

    preloader = 'launch_ros._preload'

    def __init__(
        self,
        *,
        executable: SomeSubstitutionsType,
        package: Optional[SomeSubstitutionsType] = None,
        name: Optional[SomeSubstitutionsType] = None,
        namespace: Optional[SomeSubstitutionsType] = None,
        exec_name: Optional[SomeSubstitutionsType] = None,
        parameters: Optional[list[Any]] = None,
        remappings: Optional[Iterable[Any]] = None,
        ros_arguments: Optional[Iterable[SomeSubstitutionsType]] = None,
        arguments: Optional[Iterable[SomeSubstitutionsType]] = None,
        prefix: Optional[SomeSubstitutionsType] = None,
        cwd: Optional[SomeSubstitutionsType] = None,
        env: Optional[SomeVariables] = None,
        additional_env: Optional[SomeVariables] = None,
        **kwargs: Any,
    ) -> None:
        program = text_like('executable', executable)
        if package is not None:
            program = [ExecutableInPackage(program, text_like('package', package))]
        words = [program, *_words('arguments', arguments)]
        extra = _words('ros_arguments', ros_arguments)
        super().__init__(
            cmd=[*words, *(['--ros-args', *extra] if extra else [])],
            prefix=prefix,
            name=optional_text_like('exec_name', exec_name),
            cwd=cwd,
            env=env,
            additional_env=additional_env,
            **kwargs,
        )
        self.__package = package
        self.__node_executable = executable
        self.__node_name = name
        self.__node_namespace = namespace
        self.__arguments = arguments
        self.__ros_arguments = ros_arguments
        self.__name = optional_text_like('name', name)
        self.__namespace = optional_text_like('namespace', namespace)
        self.__parameters = [] if parameters is None else normalize_parameters(parameters)
        self.__remappings = (
            []
            if remappings is None
            else normalize_remap_rules(list_like('remappings', remappings, 'tuples'))
        )
        self.__names: Optional[NodeNames] = None
        self.__expanded_parameter_arguments: list[ParameterArgument] = []
        self.__expanded_remappings: Optional[list[tuple[str, str]]] = None

    @property
    def node_package(self) -> Optional[SomeSubstitutionsType]:
        """Return the package."""
        return self.__package

    @property
    def node_executable(self) -> SomeSubstitutionsType:
        """Return the executable."""
        return self.__node_executable

    @property
    def node_name(self) -> str:
        """Return the fully qualified node name, with placeholders for unknown parts."""
        return self._known_names().full_name

    @property
    def expanded_node_namespace(self) -> str:
        """Return the expanded namespace, or a placeholder if it is unknown."""
        return self._known_names().described_namespace

    @property
    def expanded_remapping_rules(self) -> Optional[list[tuple[str, str]]]:
        """Return the expanded remappings; None before the action has been executed."""
        return self.__expanded_remappings

    def is_node_name_fully_specified(self) -> bool:
        """Check whether both the name and the namespace are known."""
        return self._known_names().are_complete

    def _known_names(self) -> NodeNames:
        if self.__names is None:
            raise RuntimeError('the name of a Node is not known before the action is executed')
        return self.__names

    @property
    def name_parts(self) -> Optional[list[Substitution]]:
        """Return the given name as a list of substitutions, None without one."""
        return self.__name

    def _perform_substitutions(self, context: LaunchContext) -> NodeNames:
        """Expand names, parameters and remappings; public tests of launch files call this."""
        names = expand_node_names(
            context,
            self.__name,
            self.__namespace,
            f'package={self.__package}, executable={self.__node_executable}, '
            f'name={self.__node_name}, namespace={self.__node_namespace}',
        )
        self.__names = names
        self.__expanded_remappings = remap_pairs(context, self.__remappings)
        self.__expanded_parameter_arguments = own_parameters(context, self.__parameters, names)
        return names

    def prepare(self, context: LaunchContext) -> None:
        """
        Expand the command line, with all ROS arguments after its last `--ros-args`.

        Their order is: name, namespace, global parameters, own parameters, remappings, and
        arguments of extensions.

        Parameters
        ----------
        context
            The launch context used to perform substitutions.

        Raises
        ------
        InvalidNameError
            The name or the namespace is not allowed in ROS.

        """
        names = self._perform_substitutions(context)
        added, known = extend_node(context, names.ros_specific_arguments(), self)
        self.process_description.prepare(
            context,
            self,
            shell=self.shell,
            extra_arguments=[
                '--ros-args',
                *rule_arguments(known[each] for each in ('name', 'ns') if each in known),
                *global_arguments(context, names),
                *parameter_arguments(self.__expanded_parameter_arguments),
                *rule_arguments(remap_rules(self.__expanded_remappings or ())),
                *added,
            ],
        )

    def _tell(self, observer: VisitObserver) -> None:
        super()._tell(observer)
        from launch_ros.utilities.effective_parameters import effective_parameters, parameter_files

        names, words = self._known_names(), self.cmd
        observer.note(
            node_name=names.name,
            node_namespace=names.namespace,
            parameter_files=parameter_files(words),
            parameters=effective_parameters(words, names.name, names.namespace),
            remappings=dict(self.__expanded_remappings or ()),
        )

    def outline(self) -> dict[str, Any]:
        """Return the description of the command, and that of the node name."""
        name = None if self.__name is None else ' + '.join(sub.describe() for sub in self.__name)
        return {**super().outline(), 'node_name': name}

    def execute(self, context: LaunchContext) -> Optional[list[LaunchDescriptionEntity]]:
        """
        Start the node once the entities of the current visit are done.

        A warning is logged if another node of this launch has the same fully qualified name.

        Parameters
        ----------
        context
            The context of the running launch.

        Raises
        ------
        InvalidNameError
            The name or the namespace is not allowed in ROS.
        RuntimeError
            The action has already been executed.

        """
        entities = super().execute(context)
        if self.is_node_name_fully_specified():
            warn_of_same_names(context, self.node_name, self.name)
        return entities


def _words(
    keyword: str,
    values: Optional[Iterable[SomeSubstitutionsType]],
) -> list[SomeSubstitutionsType]:
    """Convert values to a list; reject a string, which would be split into characters."""
    if isinstance(values, str):
        raise TypeError(
            f"the argument '{keyword}' must be a list, but it is the string '{values}'; write "
            f'{keyword}={values.split()!r}'
        )
    if values is None:
        return []
    return [text_like(keyword, value) for value in list_like(keyword, values, 'words')]
