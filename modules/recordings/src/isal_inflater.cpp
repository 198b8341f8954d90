// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/recordings/inflater.h>

#ifdef FASTLIO_WITH_ISAL

#include <cstdint>
#include <isa-l/igzip_lib.h>

namespace fastlio
{
namespace
{
class IsalInflater : public Inflater
{
 public:
  IsalInflater()
  {
    isal_inflate_init(&state_);
    state_.crc_flag = ISAL_GZIP;
  }

  void reset() override
  {
    isal_inflate_reset(&state_);
    state_.crc_flag = ISAL_GZIP;
  }

  InflateStep step(
      const unsigned char* input, std::uint32_t input_size, unsigned char* output,
      std::uint32_t output_size) override
  {
    state_.next_in = const_cast<unsigned char*>(input);  // which ISA-L does not write to
    state_.avail_in = input_size;
    state_.next_out = output;
    state_.avail_out = output_size;
    const int result = isal_inflate(&state_);
    InflateStep step;
    step.consumed = input_size - state_.avail_in;
    step.produced = output_size - state_.avail_out;
    if (result < ISAL_DECOMP_OK || result > ISAL_OUT_OVERFLOW)
      step.status = InflateStatus::Corrupt;
    else if (state_.block_state == ISAL_BLOCK_FINISH)
      step.status = InflateStatus::MemberEnd;
    return step;
  }

 private:
  inflate_state state_;
};
}  // namespace

std::unique_ptr<Inflater> makeIsalInflater()
{
  return std::make_unique<IsalInflater>();
}

}  // namespace fastlio

#else

namespace fastlio
{
std::unique_ptr<Inflater> makeIsalInflater()
{
  return nullptr;
}

}  // namespace fastlio

#endif
