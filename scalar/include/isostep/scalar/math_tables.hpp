// Constants of the elementary functions as integers. Each can be recomputed from its comment; the tests do.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/scalar/wide_int.hpp"

namespace isostep::detail {

inline constexpr std::uint64_t kPiQ62 = 0xc90fdaa22168c235u;      // round(2^62 pi)
inline constexpr std::uint64_t kHalfPiQ62 = 0x6487ed5110b4611au;  // round(2^61 pi)

/// The binary digits of 2/pi after the point, 64 a word, rounded down; two zero words stand before them so that a
/// window may begin up to 128 digits early. The last digit that a double's largest exponent asks for is number 1161.
inline constexpr std::uint64_t kTwoOverPi[21] = {0,
                                                 0,
                                                 0xa2f9836e4e441529u,
                                                 0xfc2757d1f534ddc0u,
                                                 0xdb6295993c439041u,
                                                 0xfe5163abdebbc561u,
                                                 0xb7246e3a424dd2e0u,
                                                 0x06492eea09d1921cu,
                                                 0xfe1deb1cb129a73eu,
                                                 0xe88235f52ebb4484u,
                                                 0xe99c7026b45f7e41u,
                                                 0x3991d639835339f4u,
                                                 0x9c845f8bbdf9283bu,
                                                 0x1ff897ffde05980fu,
                                                 0xef2f118b5a0a6d1fu,
                                                 0x6d367ecf27cb09b7u,
                                                 0x4f463f669e5fea2du,
                                                 0x7527bac7ebe5f17bu,
                                                 0x3d0739f78a5292eau,
                                                 0x6bfb5fb11f8d5d08u,
                                                 0x56033046fc7b6babu};

/// Row 0: sin(pi/2 sqrt(t)) / sqrt(t), row 1: cos(pi/2 sqrt(t)), for 0 <= t <= 1/4, as c0 - c1 t + c2 t^2 ... - c7 t^7.
/// Minimax of degree 7 by the exchange algorithm with 260 bits, then 2^63 c rounded; error 2^-68.2 and 2^-64.8.
inline constexpr std::uint64_t kQuarterWave[2][8] = {
    {0xc90fdaa22168c235u, 0x52aef39896f94aedu, 0x0a335e33bad56c91u, 0x0099696673156120u, 0x000541e0d2173001u,
     0x00001e3074b502deu, 0x0000007a3bb4566cu, 0x000000016c5b9398u},
    {0x8000000000000000u, 0x9de9e64df22ef243u, 0x20783e1036b5586du, 0x02aba78fc7921fa5u, 0x001e1f50683565a9u,
     0x0000d368f63cafd8u, 0x000003f39882a970u, 0x0000000d9326647bu}};

/// round(2^(69 - k) atan(i / 64)), i = 0 .. 64, where 2^k is the leading bit of i: all with 62 digits or more.
inline constexpr std::uint64_t kAtan64ths[65] = {
    0x0000000000000000u, 0x7ffd556eedca6adeu, 0x7ff556eea5d892a1u, 0xbfdc0c2186d14fcfu, 0x7fd56edcb3f7a71bu,
    0x9facf873e2aceb59u, 0xbf70c13017887461u, 0xdf1cf5f3783e1befu, 0x7f56ea6ab0bdb719u, 0x8f0fd7d821b93726u,
    0x9eb77746331362c3u, 0xae4c08f1f6134efbu, 0xbdcbda5e72d81134u, 0xcd35474b643130e8u, 0xdc86ba9493051023u,
    0xebbeaef902b9b38du, 0x7d6dd7e4b203758bu, 0x84ee2cbec31b12c6u, 0x8c5fad185f8bc131u, 0x93c1b902bf7a2df1u,
    0x9b13b9b83f5e5e6au, 0xa25521b615784d45u, 0xa9856cca8e6a4edbu, 0xb0a420184e7f0cb2u, 0xb7b0ca0f26f78474u,
    0xbeab025b1d9fbad4u, 0xc59269ca50d92b6eu, 0xcc66aa2a6b58c33du, 0xd327761e611fe5b6u, 0xd9d488ed32e3635cu,
    0xe06da64a764f7c68u, 0xe6f29a19609a84bau, 0x76b19c1586ed3da3u, 0x79dfadfc5d68d10eu, 0x7d03742d50505f2eu,
    0x801ce39e0d205c9au, 0x832bf4a6d9867e2au, 0x8630a2dada1ed066u, 0x892aecdfde9547b5u, 0x8c1ad445f3e09b8cu,
    0x8f005d5ef7f59f9bu, 0x91db8f1664f350e2u, 0x94ac72c9847186f6u, 0x97731420365e538cu, 0x9a2f80e671bdda20u,
    0x9ce1c8e6a0b8cdbau, 0x9f89fdc4f4b7a1edu, 0xa22832dbcadaae09u, 0xa4bc7d1934f70924u, 0xa746f2ddb7602294u,
    0xa9c7abdc4830f5c9u, 0xac3ec0fb997dd6a2u, 0xaeac4c38b4d8c080u, 0xb110688aebdc6f6au, 0xb36b31c91f043691u,
    0xb5bcc49059ecc4b0u, 0xb8053e2bc2319e74u, 0xba44bc7dd470782fu, 0xbc7b5deae98af281u, 0xbea94144fd049aacu,
    0xc0ce85b8ac526641u, 0xc2eb4abb661628b6u, 0xc4ffaffabf8fbd55u, 0xc70bd54ce602ee14u, 0x6487ed5110b4611au};

inline constexpr UInt128Parts kLog2E = {0xb8aa3b295c17f0bbu, 0xbe87fed0691d3e89u};    // round(2^127 / ln 2)
inline constexpr UInt128Parts kLn2Q128 = {0xb17217f7d1cf79abu, 0xc9e3b39803f2f6afu};  // round(2^128 ln 2)
inline constexpr UInt128Parts kLn2Q116 = {0x000b17217f7d1cf7u, 0x9abc9e3b39803f2fu};  // round(2^116 ln 2)

/// ((2^r - 1) / r - ln 2) / r for 0 <= r <= 1/64, as c0 + c1 u + ... + c5 u^5 with u = 64 r. Minimax of degree 5 by the
/// exchange algorithm with 400 bits, then 2^64 c rounded; error 2^-66.5.
inline constexpr std::uint64_t kExpSeries[6] = {0x3d7f7bff058b1d51u, 0x0038d611ae09418cu, 0x0000276556df740bu,
                                                0x00000015d87fe9f9u, 0x000000000a1843e7u, 0x00000000000403c3u};

/// (r - ln(1 + r)) / r^2, |r| <= 1/128 + 2^-16, as c0 - c1 u + c2 u^2 ... - c7 u^7 with u = 64 r. Minimax of degree 7
/// by the exchange algorithm with 400 bits, then 2^64 c rounded; error 2^-66.3.
inline constexpr std::uint64_t kLogSeries[8] = {0x8000000000000000u, 0x0155555555555555u, 0x000400000000001au,
                                                0x00000cccccccccceu, 0x0000002aaaaaa8a7u, 0x0000000092492486u,
                                                0x0000000002000cdau, 0x0000000000071cacu};

/// round(2^(127 + i / 64)).
inline constexpr UInt128Parts kExp2Of64ths[64] = {
    {0x8000000000000000u, 0x0000000000000000u}, {0x8164d1f3bc030773u, 0x7be56527bd14def5u},
    {0x82cd8698ac2ba1d7u, 0x3e2a475b46520bffu}, {0x843a28c3acde4046u, 0x1af92eca13fd1582u},
    {0x85aac367cc487b14u, 0xc5c95b8c2154c1b2u}, {0x871f61969e8d1010u, 0x3a1727c57b52a956u},
    {0x88980e8092da8527u, 0x5df8d76c98c67563u}, {0x8a14d575496efd9au, 0x080ca1d92c3680c2u},
    {0x8b95c1e3ea8bd6e6u, 0xfbe4628758a53c90u}, {0x8d1adf5b7e5ba9e5u, 0xb4c7b4968e41ad36u},
    {0x8ea4398b45cd53c0u, 0x2dc0144c8783d4c6u}, {0x9031dc431466b1dcu, 0x775814a8494e87e2u},
    {0x91c3d373ab11c336u, 0x0fd6d8e0ae5ac9d8u}, {0x935a2b2f13e6e92bu, 0xd339940e9d924ee7u},
    {0x94f4efa8fef70961u, 0x2e8afad12551de54u}, {0x96942d3720185a00u, 0x48ea9b683a9c22c5u},
    {0x9837f0518db8a96fu, 0x46ad23182e42f6f6u}, {0x99e0459320b7fa64u, 0xe43086cb34b5fcafu},
    {0x9b8d39b9d54e5538u, 0xa2a817a2a3cc3f1fu}, {0x9d3ed9a72cffb750u, 0xde494cf050e99b0bu},
    {0x9ef5326091a111adu, 0xa0911f09ebb9fdd1u}, {0xa0b0510fb9714fc2u, 0x192dc79edb0fd9a9u},
    {0xa27043030c496818u, 0x9b7a04ef80cfdea8u}, {0xa43515ae09e6809eu, 0x0d1db4831781e1efu},
    {0xa5fed6a9b15138eau, 0x1cbd7f621710701bu}, {0xa7cd93b4e9653569u, 0x9ec5b4d5039f72afu},
    {0xa9a15ab4ea7c0ef8u, 0x541e24ec3531fa73u}, {0xab7a39b5a93ed337u, 0x658023b2759e0079u},
    {0xad583eea42a14ac6u, 0x4980a8c8f59a2ec4u}, {0xaf3b78ad690a4374u, 0xdf26101ccbb35033u},
    {0xb123f581d2ac258fu, 0x87d037e96d215d8eu}, {0xb311c412a9112489u, 0x3ecf14dc798a519cu},
    {0xb504f333f9de6484u, 0x597d89b3754abe9fu}, {0xb6fd91e328d17791u, 0x07165f0ddd541a5au},
    {0xb8fbaf4762fb9ee9u, 0x1b879778566b65a2u}, {0xbaff5ab2133e45fbu, 0x74d519d24593838cu},
    {0xbd08a39f580c36beu, 0xa8811fb66d0faf7au}, {0xbf1799b67a731082u, 0xe815d0abcbf0b851u},
    {0xc12c4cca66709456u, 0x7c457d59a50087b5u}, {0xc346ccda24976407u, 0x20ec856128b83a42u},
    {0xc5672a115506daddu, 0x3e2ad0c964dd9f37u}, {0xc78d74c8abb9b15cu, 0xc13a2e3976c0277eu},
    {0xc9b9bd866e2f27a2u, 0x80e1f92a0511697eu}, {0xcbec14fef2727c5cu, 0xf4907c8f45ebf6ddu},
    {0xce248c151f8480e3u, 0xe235838f95f2c6edu}, {0xd06333daef2b2594u, 0xd6d45c6559a4d502u},
    {0xd2a81d91f12ae45au, 0x12248e57c3de4028u}, {0xd4f35aabcfedfa1fu, 0x5921deffa6262c5bu},
    {0xd744fccad69d6af4u, 0x39a68bb9902d3fdeu}, {0xd99d15c278afd7b5u, 0xfe873deca3e12bacu},
    {0xdbfbb797daf23755u, 0x3d840d5a9e29aa64u}, {0xde60f4825e0e9123u, 0xdd07a2d9e8466859u},
    {0xe0ccdeec2a94e111u, 0x065895048dd333cau}, {0xe33f8972be8a5a51u, 0x09bfe90795980eedu},
    {0xe5b906e77c8348a8u, 0x1e5e8f4a4edbb0edu}, {0xe8396a503c4bdc68u, 0x791790d0ac70c7deu},
    {0xeac0c6e7dd24392eu, 0xd02d75b3706e54fbu}, {0xed4f301ed9942b84u, 0x600d2db6a64bfb12u},
    {0xefe4b99bdcdaf5cbu, 0x46561cf6948db913u}, {0xf281773c59ffb139u, 0xe8980a9cc8f47a4bu},
    {0xf5257d152486cc2cu, 0x7b9d0c7aed980fc3u}, {0xf7d0df730ad13bb8u, 0xfe90d496d60fb6ebu},
    {0xfa83b2db722a033au, 0x7c25bb14315d7fcdu}, {0xfd3e0c0cf486c174u, 0x853f3a5931e0ee03u}};

/// Around 1 + j / 64, j = 0 .. 64: reciprocal = round(2^16 / (1 + j / 64)), log = round(2^116 ln(2^16 / reciprocal)).
/// The last cell's log is ln 2 itself: one octave lower it cancels, and numbers just below 1 lose nothing.
struct LogCell {
  std::uint32_t reciprocal;
  UInt128Parts log;
};
inline constexpr LogCell kLogCells[65] = {
    {0x10000u, {0x0000000000000000u, 0x0000000000000000u}}, {0x0fc10u, {0x00003f7d51627807u, 0xb249ec5f9384d383u}},
    {0x0f83eu, {0x00007e0b6c39e8ccu, 0x01893949a4747ab3u}}, {0x0f48au, {0x0000bb9b47b358e7u, 0x5591d9053ce841ffu}},
    {0x0f0f1u, {0x0000f85086009315u, 0x32b690fa3621d10fu}}, {0x0ed73u, {0x0001341db961bd9du, 0x092aed8cba5a2699u}},
    {0x0ea0fu, {0x00016f06a8afa8b4u, 0x5e33bad52b165efeu}}, {0x0e6c3u, {0x0001a92193a589d6u, 0x0614c9016aa5fe1au}},
    {0x0e38eu, {0x0001e27476e32f2eu, 0x73f401d554420c2eu}}, {0x0e070u, {0x00021af3cf9a91cbu, 0x422847849e3a781fu}},
    {0x0dd68u, {0x000252a65f047ea4u, 0x542b6a38ca1cbd56u}}, {0x0da74u, {0x000289a66d9977a3u, 0xcd4fd08374654c4au}},
    {0x0d794u, {0x0002bfea0e15727au, 0x8e63d596970646c4u}}, {0x0d4c7u, {0x0002f57a6044c7a2u, 0x2b4e351efb7dedadu}},
    {0x0d20du, {0x00032a4dd39ebcd6u, 0x93fd7c003c7ff027u}}, {0x0cf64u, {0x00035e8229d29fffu, 0x4e1a3287551b8126u}},
    {0x0cccdu, {0x000391faf8f3d344u, 0x202f69ae883dd53du}}, {0x0ca46u, {0x0003c4d76dc8305bu, 0x9f7325995521a89bu}},
    {0x0c7ceu, {0x0003f7240dabcfc5u, 0x51fffe26dc4822e2u}}, {0x0c566u, {0x000428c4b89d8638u, 0xb97d045044aaf4feu}},
    {0x0c30cu, {0x000459db2aeb6983u, 0x963c8b4ab263db05u}}, {0x0c0c1u, {0x00048a4b3ef4bad9u, 0x3854ad2e2ab9a499u}},
    {0x0be83u, {0x0004ba382eb8494cu, 0x2700879c36975a8bu}}, {0x0bc52u, {0x0004e99b955c937bu, 0x3e8174591502c219u}},
    {0x0ba2fu, {0x00051858f08a37afu, 0x51ee25b84959f02cu}}, {0x0b817u, {0x000546aba1cb7e8bu, 0x4273a4ad8d4011c4u}},
    {0x0b60bu, {0x00057477efd84473u, 0x60d90a69947f60f7u}}, {0x0b40bu, {0x0005a1b7c7a7cdabu, 0xf06f6b4338cca6efu}},
    {0x0b216u, {0x0005ce7bfdb01401u, 0xef38a75504c830f8u}}, {0x0b02cu, {0x0005fabf0ee0b3f0u, 0xd9823ed3427ed8ccu}},
    {0x0ae4cu, {0x00062692e1b17096u, 0xf569da604a223a74u}}, {0x0ac77u, {0x000651dac70b8e3du, 0x479d3912a0357624u}},
    {0x0aaabu, {0x00067cc0fb31e612u, 0x520338b2d78bdaefu}}, {0x0a8e8u, {0x0006a74126a7a212u, 0xab52283d51dc85f1u}},
    {0x0a72fu, {0x0006d13e5ef325d8u, 0xa33a6615a50e33d3u}}, {0x0a57fu, {0x0006facc276b6b5eu, 0x7edb07ce749e4c7du}},
    {0x0a3d7u, {0x000723fef1e6ae88u, 0x6b5ecb61121576f1u}}, {0x0a238u, {0x00074cb99f815af5u, 0x1077c672f4e705b0u}},
    {0x0a0a1u, {0x0007751101334327u, 0x11ef5e42802942f8u}}, {0x09f11u, {0x00079d1ad878ea63u, 0x5fd6bfff563dd5a3u}},
    {0x09d8au, {0x0007c49fd7ec41bbu, 0x1781cf96eea51b7eu}}, {0x09c0au, {0x0007ebcfa3df8ec7u, 0x5ae15e32c6e67387u}},
    {0x09a91u, {0x000812a6d2d31a7fu, 0x5e18dff5aa0b2290u}}, {0x0991fu, {0x00083921ee0eac20u, 0x2e1a76abb7559497u}},
    {0x097b4u, {0x00085f3d72131541u, 0x70a1a532f01220b7u}}, {0x09650u, {0x000884f5cf17264bu, 0x699ca4f82f9a6a68u}},
    {0x094f2u, {0x0008aa62e97a72f4u, 0xd51cef2b20849c8eu}}, {0x0939bu, {0x0008cf661a396134u, 0x5ec995d8965656b3u}},
    {0x09249u, {0x0008f433af38a068u, 0x344b8628501405acu}}, {0x090feu, {0x00091890ebe121a0u, 0xb4cf4cb3bedb1348u}},
    {0x08fb8u, {0x00093cb30945588du, 0x8b1178f432d65b4du}}, {0x08e78u, {0x0009607af6a36746u, 0x24bd6258e328282cu}},
    {0x08d3eu, {0x000983e599a8a85eu, 0xc7dadc90f4a03b92u}}, {0x08c09u, {0x0009a70d0ed01569u, 0x0c6f49eccc966d22u}},
    {0x08ad9u, {0x0009c9eee9ab270cu, 0xd3c221445b6e076cu}}, {0x089aeu, {0x0009ec88b53a6d7du, 0xdea2448ed7f35c35u}},
    {0x08889u, {0x000a0eb9f4295953u, 0x9f8a0bf52b59c6a5u}}, {0x08768u, {0x000a30bbe1114f5fu, 0xf131048636290cfdu}},
    {0x0864cu, {0x000a526e2ede3f59u, 0xee6b8d37849fd64bu}}, {0x08534u, {0x000a73ed08dbb5d8u, 0x4eada1847818376au}},
    {0x08421u, {0x000a9517932dead5u, 0x779139b0e02f0373u}}, {0x08312u, {0x000ab60a6adfabcfu, 0xd4b0380939718721u}},
    {0x08208u, {0x000ad6a4261b4f96u, 0x92ea2ea84e33ef8du}}, {0x08102u, {0x000af701d4920d3au, 0xb875af5ad3cbb034u}},
    {0x08000u, {0x000b17217f7d1cf7u, 0x9abc9e3b39803f2fu}}};

}  // namespace isostep::detail
