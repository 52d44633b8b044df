# SPDX-License-Identifier: Apache-2.0
"""Installation of the package."""

from glob import glob

from setuptools import find_packages, setup

package_name = 'demo_nodes_cpp'
INDEX = 'share/ament_index/resource_index'

setup(
    name=package_name,
    version='0.1.0',
    packages=find_packages(exclude=['test']),
    package_data={package_name: ['py.typed']},
    data_files=[
        (f'{INDEX}/packages', [f'resource/{package_name}']),
        (f'{INDEX}/rclcpp_components', [f'resource/rclcpp_components/{package_name}']),
        (f'share/{package_name}', ['package.xml']),
        (f'share/{package_name}/launch/topics', glob('launch/topics/*')),
        (f'share/{package_name}/launch/services', glob('launch/services/*')),
    ],
    install_requires=['setuptools'],
    zip_safe=True,
    maintainer='Humanoid workspace maintainers',
    maintainer_email='maintainers@humanoid-workspace.dev',
    description='Executables and launch files of demo_nodes_cpp, over demo_nodes_py.',
    license='Apache-2.0',
    extras_require={'test': ['pytest']},
    entry_points={
        'console_scripts': [
            'talker = demo_nodes_cpp.talker:main',
            'listener = demo_nodes_py.topics.listener:main',
            'listener_best_effort = demo_nodes_cpp.listener_best_effort:main',
            'add_two_ints_server = demo_nodes_py.services.add_two_ints_server:main',
            'add_two_ints_client = demo_nodes_py.services.add_two_ints_client:main',
            'add_two_ints_client_async = demo_nodes_py.services.add_two_ints_client_async:main',
            'introspection_service = demo_nodes_cpp.introspection:run_service',
            'introspection_client = demo_nodes_cpp.introspection:run_client',
            'parameter_blackboard = demo_nodes_cpp.parameter_blackboard:main',
            'even_parameters_node = demo_nodes_cpp.even_parameters_node:main',
            'matched_event_detect = demo_nodes_py.events.matched_event_detect:main',
            'use_logger_service = demo_nodes_py.logging.use_logger_service:main',
        ],
    },
)
