#include "app/study/Failure.h"

#include "model/base/Cancelled.h"
#include "model/base/Error.h"

#include <filesystem>
#include <new>

namespace palp {

std::string fileFailureInWords(const std::filesystem::filesystem_error& failure) {
  return failure.path1().string() + ": cannot be reached: " + failure.code().message();
}

std::string failureInWords(const std::exception_ptr& failure) {
  try {
    std::rethrow_exception(failure);
  } catch (const Error& refused) {
    return refused.what();
  } catch (const Cancelled& cancelled) {
    return cancelled.what();
  } catch (const std::filesystem::filesystem_error& unreached) {
    return fileFailureInWords(unreached);
  } catch (const std::bad_alloc&) {
    return "not enough memory";
  } catch (const std::exception& mistake) {
    return std::string("internal error: ") + mistake.what();
  } catch (...) {
    return "internal error of an unknown kind";
  }
}

} // namespace palp
