# SPDX-License-Identifier: Apache-2.0
"""Installation of the package."""

from setuptools import find_packages, setup

package_name = 'ros2controlcli'
verbs = (
    'list_controller_types',
    'list_controllers',
    'list_hardware_components',
    'list_hardware_interfaces',
    'load_controller',
    'reload_controller_libraries',
    'set_controller_state',
    'set_hardware_component_state',
    'switch_controllers',
    'unload_controller',
    'view_controller_chains',
)


def class_of(verb: str) -> str:
    """
    Build the class name of a verb: for list_controllers, ListControllersVerb.

    Parameters
    ----------
    verb
        The verb, in snake case.

    """
    return ''.join(map(str.capitalize, verb.split('_'))) + 'Verb'


setup(
    name=package_name,
    version='0.1.0',
    packages=find_packages(exclude=['test']),
    package_data={package_name: ['py.typed']},
    data_files=[
        ('share/ament_index/resource_index/packages', [f'resource/{package_name}']),
        (f'share/{package_name}', ['package.xml']),
    ],
    install_requires=['setuptools'],
    zip_safe=True,
    author='Humanoid workspace maintainers',
    maintainer='Humanoid workspace maintainers',
    maintainer_email='maintainers@humanoid-workspace.dev',
    description='The command `ros2 control`: controllers and hardware of a controller manager.',
    license='Apache-2.0',
    tests_require=['pytest'],
    entry_points={
        'ros2cli.command': ['control = ros2controlcli.command.control:ControlCommand'],
        'ros2controlcli.verb': [
            f'{verb} = ros2controlcli.verb.{verb}:{class_of(verb)}' for verb in verbs
        ],
    },
)
