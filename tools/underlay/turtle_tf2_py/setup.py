# SPDX-License-Identifier: Apache-2.0
"""Installation of the package."""

from glob import glob

from setuptools import find_packages, setup

package_name = 'turtle_tf2_py'

setup(
    name=package_name,
    version='0.1.0',
    packages=find_packages(exclude=['test']),
    package_data={package_name: ['py.typed']},
    data_files=[
        ('share/ament_index/resource_index/packages', [f'resource/{package_name}']),
        (f'share/{package_name}', ['package.xml']),
        (f'share/{package_name}/launch', sorted(glob('launch/*.launch.py'))),
        (f'share/{package_name}/rviz', sorted(glob('rviz/*.rviz'))),
    ],
    install_requires=['setuptools'],
    zip_safe=False,
    maintainer='Humanoid workspace maintainers',
    maintainer_email='maintainers@humanoid-workspace.dev',
    description='The nodes of the tf2 tutorials: turtles as frames, one of which follows another.',
    license='Apache-2.0',
    extras_require={'test': ['pytest']},
    entry_points={
        'console_scripts': [
            'turtle_tf2_broadcaster = turtle_tf2_py.turtle_tf2_broadcaster:main',
            'turtle_tf2_listener = turtle_tf2_py.turtle_tf2_listener:main',
            'static_turtle_tf2_broadcaster = turtle_tf2_py.static_turtle_tf2_broadcaster:main',
            'fixed_frame_tf2_broadcaster = turtle_tf2_py.carrot_broadcasters:run_fixed',
            'dynamic_frame_tf2_broadcaster = turtle_tf2_py.carrot_broadcasters:run_dynamic',
            'turtle_tf2_message_broadcaster = turtle_tf2_py.turtle_tf2_message_broadcaster:main',
        ],
    },
)
