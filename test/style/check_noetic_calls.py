"""What Ubuntu 20.04 (ROS Noetic) would not compile or run, as far as reading tells: calls that its versions
of our libraries lack, and Python that is not Python 3.8. scripts/check_noetic compiles besides.
"""
import ast
import re

from common import files, finish, read

# (what, library, the version that brought it). Of 20.04: OpenCV 4.2, yaml-cpp 0.6.2, Eigen 3.3.7, Boost
# 1.71, Embree 3.6.1, CMake 3.16.3, GCC 9, nlohmann-json 3.7.3, SDFormat 9, Assimp 5.0, zlib 1.2.11,
# GoogleTest 1.10, Python 3.8.
CPP = [
    (r"cv::(imcount|imdecodemulti)\b", "OpenCV", "4.5"),
    (r"cv::(reduceArgM(ax|in)|ImageCollection|flipND|hasNonZero|broadcast|finiteMask|transposeND)\b",
     "OpenCV", "4.6"),
    (r"cv::(imreadanimation|imwriteanimation|imencodemulti|Animation)\b", "OpenCV", "4.11"),
    (r"\bIMREAD_COLOR_(RGB|BGR)\b|\bIMWRITE_JPEG_SAMPLING_FACTOR\b", "OpenCV", "4.5.5"),
    (r"yaml-cpp/(depthguard|noexcept)\.h|YAML::(DeepRecursion|DepthGuard|FpToString)\b|"
     r"RestoreGlobalModifiedSettings|SetShowTrailingZero", "yaml-cpp", "0.7"),
    (r"\bas<std::(string_view|unordered_map|valarray)\b|YAML::convert<std::(string_view|unordered_map)",
     "yaml-cpp", "0.7"),
    (r"Eigen::(seq|seqN|lastN|all|last|lastp1|fix|placeholders|indexing|bfloat16)\b", "Eigen", "3.4"),
    (r"Eigen::((Row)?Vector|(Row)?Vector[234X]|Matrix[234X]|Array[234X]|ArrayXX)<", "Eigen", "3.4"),
    (r"\bEigen::\w+ \w+\{\{", "Eigen", "3.4 (initializer lists)"),
    (r"\.reshaped\(|\bPropagate(NaN|Numbers)\b|\.(col|row)wise\(\)\.(c?begin|c?end)\(", "Eigen", "3.4"),
    (r"<boost/(json|leaf|pfr|nowide|static_string|stl_interfaces|lambda2|describe|url|charconv|scope|"
     r"compat|mysql|redis|parser|hash2|cobalt|core/(span|bit|string_view|data)|"
     r"unordered/(unordered_(flat|node)|concurrent_flat)\w*)[/.]", "Boost", "1.73 or later"),
    (r"boost::(span|urls|json|pfr)\b|boost::unordered_(flat|node)_(map|set)\b", "Boost", "1.75 or later"),
    (r"\brtcCollide\b|\brtcSetGeometryTransformQuaternion\b|\brtcInitQuaternionDecomposition\b|"
     r"\bRTC_FORMAT_QUATERNION_DECOMPOSITION\b", "Embree", "3.7"),
    (r"\bRTC_GEOMETRY_TYPE_CONE_LINEAR_CURVE\b|\brtcSetGeometryMaxRadiusScale\b", "Embree", "3.12"),
    (r"embree4/|\bRTC(Intersect|Occluded|PointQuery)Arguments\b|\brtcInit(Intersect|Occluded)Arguments\b|"
     r"\brtcTraversable|\brtcGetSceneTraversable\b|\bRTC_FEATURE_FLAG_|\brtcForward", "Embree", "4.0"),
    (r"\b__builtin_(shufflevector|clear_padding|bit_cast)\b", "GCC", "11"),
    (r"#include <(bit|concepts|numbers|ranges|span|format|source_location|syncstream|semaphore|latch|"
     r"barrier|stop_token|coroutine|expected)>", "GCC", "C++20"),
    (r"std::atomic<std::(shared|weak)_ptr\b", "GCC", "12"),
    (r"\b(from|to)_chars\(", "GCC", "11 (of floating point; strtod and decimalText do it)"),
    (r"\bNLOHMANN_(DEFINE_TYPE|JSON_SERIALIZE_ENUM_STRICT)|\bordered_json\b|\bignore_comments\b",
     "nlohmann-json", "3.9"),
    (r"\bsdf::(ParserConfig|PrintConfig|InterfaceModel)\b|\broot\.Model\(\)|#include <gz/", "SDFormat",
     "11 or later"),
    (r"\bcrc32_combine_(gen|op)\b", "zlib", "1.2.12"),
    (r"\bGTEST_(FLAG_SET|FLAG_GET|ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST)\b|\bThrowsMessage\b|"
     r"\bGTEST_FAIL_AT\b|\bIsTrue\(|\bDistanceFrom\(", "GoogleTest", "1.11"),
    (r"\btj3\w+\(", "libjpeg-turbo", "3.0"),
]

CMAKE = [
    (r"\b(cmake_path|cmake_language|block|cmake_pkg_config)\s*\(", "CMake", "3.18 or later"),
    (r"\bfile\s*\(\s*(ARCHIVE_\w+|CONFIGURE|REAL_PATH|CHMOD\w*|COPY_FILE)\b", "CMake", "3.18 or later"),
    (r"\bstring\s*\(\s*JSON\b|\bIN ZIP_LISTS\b|\bCMAKE_CURRENT_FUNCTION|\bUNITY_BUILD_MODE\b", "CMake",
     "3.17 or later"),
    (r"\bfind_(library|program|path|file)\s*\([^)]*\bREQUIRED\b", "CMake", "3.18"),
    (r"\bCOMMAND_ERROR_IS_FATAL\b|\bRUNTIME_DEPENDENCY_SET\b|\bENVIRONMENT_MODIFICATION\b|"
     r"\bFILE_SET\b|\breturn\s*\(\s*PROPAGATE\b|\bPROJECT_IS_TOP_LEVEL\b|\bUSE_SOURCE_PERMISSIONS\b|"
     r"\bCMAKE_COMPILE_WARNING_AS_ERROR\b|\bCMAKE_COLOR_DIAGNOSTICS\b", "CMake", "3.19 or later"),
    (r"\$<(PATH|LIST|LINK_LIBRARY|LINK_GROUP|COMPILE_ONLY|TARGET_RUNTIME_DLLS|DEVICE_LINK|"
     r"COMMAND_CONFIG|OUTPUT_CONFIG):|\$<(TARGET_RUNTIME_DLLS|CONFIG:\w+,)", "CMake", "3.18 or later"),
    (r"\bcmake_minimum_required\s*\(\s*VERSION\s+(3\.(1[7-9]|[2-9]\d)|[4-9])", "CMake", "3.17 or later"),
    (r"\b(CheckSourceCompiles|CheckLinkerFlag|CheckCompilerFlag|CheckSourceRuns)\b", "CMake", "3.18"),
]

SHELL = [
    (r"\bctest\b.*--(test-dir|output-junit|preset)\b", "CMake", "3.20"),
    (r"\bcmake\b.*(--preset\b|--fresh\b|-E (rm|cat)\b)", "CMake", "3.17 or later"),
]

PYTHON = [
    (r"\.remove(prefix|suffix)\(|\bfunctools\.cache\b|\bast\.unparse\b|\bmath\.(lcm|nextafter|ulp)\(|"
     r"\.(with_stem|is_relative_to)\(|\brandbytes\(|\bimport (zoneinfo|graphlib)\b|cancel_futures=|"
     r"BooleanOptionalAction|\bto_thread\(", "Python", "3.9"),
    (r"\bzip\(.*\bstrict=|\bpairwise\(|\.bit_count\(\)|\bslots=True\b|\bkw_only=|\broot_dir=", "Python",
     "3.10"),
    (r"\bimport tomllib\b|\bcontextlib\.chdir\b|\bTaskGroup\b|\bExceptionGroup\b|\bdatetime\.UTC\b",
     "Python", "3.11"),
    (r"(:|->) *(list|dict|tuple|set|type)\[", "Python", "3.9 (generic built-in types)"),
    (r"(:|->) *[\w.]+ \| (None|[\w.]+)\b", "Python", "3.10 (unions by |)"),
]


def is_python(name):
    return name.endswith(".py") or "python" in read(name).split("\n")[0]


def scripts():
    """The programs without an ending, and with .py or .sh: (Python ones, shell ones)."""
    names = files(("scripts", ".ci", "test/style", "test/ros", "test/browser"), ("",))
    names += files(("benchmark",), ("",))
    names = [name for name in names
             if re.search(r"(\.py|\.sh|/[^./]+)$", name) and "__pycache__" not in name]
    python = [name for name in names if is_python(name)]
    return python, [name for name in names if name not in python]


def calls(names, table):
    for name in names:
        text = read(name)
        for expression, library, version in table:
            for match in re.finditer(expression, text):
                yield "%s:%d: %s is of %s %s" % (name, text.count("\n", 0, match.start()) + 1,
                                                 " ".join(match.group(0).split()), library, version)


def not_python_38(name):
    try:
        ast.parse(read(name), name, feature_version=(3, 8))
    except SyntaxError as error:
        yield "%s:%s: not Python 3.8: %s" % (name, error.lineno, error.msg)


def main():
    cpp = files(("include", "src", "test", "benchmark", "examples"), (".h", ".cpp"))
    cmake = files(("cmake", "src", "test", "examples"), (".cmake", "CMakeLists.txt")) + ["CMakeLists.txt"]
    python, shell = scripts()
    own = ("test/style/check_noetic_calls.py", "test/style/check_checks.py")  # name them all
    complaints = list(calls(cpp, CPP)) + list(calls(cmake, CMAKE)) + list(calls(shell, SHELL))
    complaints += calls([name for name in python if name not in own], PYTHON)
    complaints += [text for name in python for text in not_python_38(name)]
    finish(complaints, "%d C++ files, %d of CMake, %d scripts" %
           (len(cpp), len(cmake), len(python) + len(shell)))


main()
