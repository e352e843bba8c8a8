#!/usr/bin/python3
"""Each source below src has a test of its own name, or a word here on which test covers it.

usage: check_tests.py

src/core/cloud/voxel_merger.cpp has test/core/cloud/test_voxel_merger.cpp. The plain twins of kernels are tested with
them, and programs (src/tools, src/nodelets) as programs. Prints one line for each source without a test; exits 1 if there
is one.
"""
import os
import subprocess
import sys

TOP = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
PROGRAMS = ('src/tools/', 'src/nodelets/')
# Sources that are one half of another one, or that only a whole run shows.
COVERED_BY = {
    'background_regions': 'test_background_fusion',
    'cloud_reader': 'test_cloud_files',
    'cloud_transformer': 'test_robot',
    'depth_node_frame': 'test_depth_node',
    'depth_node_publication': 'test_depth_node',
    'depth_node_services': 'test_robot',
    'depth_node_watch': 'test_node_faults',
    'exposure_kernels': 'test_exposure_views',
    'format_colmap': 'test_planar_rig',
    'format_folders': 'test_format_zoo',
    'format_frames': 'test_format_zoo',
    'format_hci': 'test_format_zoo',
    'format_index': 'test_format_zoo',
    'format_place_words': 'test_format_zoo',
    'format_rows_and_columns': 'test_format_zoo',
    'format_transforms': 'test_planar_rig',
    'normal_equations': 'test_joint_adjustment',
    'node_diagnostics': 'test_depth_node_behaviour',
    'node_parameters': 'test_parameters',
    'parameter_check': 'test_parameters',
    'posix_files': 'test_files',
    'result_files': 'test_tools',
    'result_publisher': 'test_depth_node',
    'batch_fusion': 'test_dense_cloud',
    'surface_fusion': 'test_dense_cloud',
    'textured_pixels': 'test_view_samples',
    'surface_map': 'test_dense_cloud',
    'surface_warp': 'test_dense_cloud',
    'view_frames': 'test_robot',
    'view_input': 'test_depth_node_behaviour',
    'view_messages': 'test_light_field_assembler',
    'view_mask': 'test_masks',
    'voxel_merger': 'test_point_cloud',
    'yaml_parameter': 'test_view_array',
}


def tracked(*folders):
    listing = subprocess.check_output(['git', '-C', TOP, 'ls-files', '--cached', '--others', '--exclude-standard',
                                       *folders], text=True)
    return [path for path in listing.split() if os.path.exists(os.path.join(TOP, path))]


def main():
    tests = {os.path.splitext(os.path.basename(path))[0] for path in tracked('test') if path.endswith('.cpp')}
    findings = [f'{source} is said to be covered by {test}, which is not there' for source, test in COVERED_BY.items()
                if test not in tests]
    sources = [path for path in tracked('src') if path.endswith('.cpp') and not path.startswith(PROGRAMS)]
    for path in sources:
        name = os.path.splitext(os.path.basename(path))[0]
        if name.endswith('_plain'):
            continue
        if f'test_{name}' not in tests and name not in COVERED_BY:
            findings.append(f'{path}: there is no test_{name}.cpp')
        if f'test_{name}' in tests and name in COVERED_BY:
            findings.append(f'{path} has a test of its own; strike it from this script')
    print('\n'.join(findings) if findings else f'tests: {len(sources)} sources')
    return 1 if findings else 0


if __name__ == '__main__':
    sys.exit(main())
