# Copies FROM to TO with the constant CONSTANT times FACTOR. It must be defined once, as "CONSTANT = S(number)": else
# nothing would be tested, and that is an error.
file(READ ${FROM} text)
set(definition "${CONSTANT} = S\\([0-9.]+\\)")
string(REGEX MATCHALL "${definition}" found "${text}")
list(LENGTH found count)
if(NOT count EQUAL 1)
  message(FATAL_ERROR "${FROM} defines ${CONSTANT} ${count} times: tell tests/lab/CMakeLists.txt what to break now")
endif()
string(REPLACE "${found}" "${found} * S(${FACTOR})" wrong "${text}")
file(WRITE ${TO} "${wrong}")
