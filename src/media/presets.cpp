// SPDX-License-Identifier: BSD-2-Clause
#include "media/presets.h"

#include <algorithm>
#include <array>

namespace pbrtmedia {
namespace {

// Name, reduced scattering and absorption for R, G, B, in 1/mm. Narasimhan et al. give scattering and mean
// cosine g; reduced scattering is scattering * (1 - g).
constexpr std::array<MediumPreset, 47> kPresets{{
    // Jensen, Marschner, Levoy & Hanrahan 2001, "A Practical Model for Subsurface Light Transport"
    {"Apple", Rgb(2.29f, 2.39f, 1.97f), Rgb(.0030f, .0034f, .046f)},
    {"Chicken1", Rgb(.15f, .21f, .38f), Rgb(.015f, .077f, .19f)},
    {"Chicken2", Rgb(.19f, .25f, .32f), Rgb(.018f, .088f, .20f)},
    {"Cream", Rgb(7.38f, 5.47f, 3.15f), Rgb(.0002f, .0028f, .0163f)},
    {"Ketchup", Rgb(.18f, .07f, .03f), Rgb(.061f, .97f, 1.45f)},
    {"Marble", Rgb(2.19f, 2.62f, 3.00f), Rgb(.0021f, .0041f, .0071f)},
    {"Potato", Rgb(.68f, .70f, .55f), Rgb(.0024f, .0090f, .12f)},
    {"Skimmilk", Rgb(.70f, 1.22f, 1.90f), Rgb(.0014f, .0025f, .0142f)},
    {"Skin1", Rgb(.74f, .88f, 1.01f), Rgb(.032f, .17f, .48f)},
    {"Skin2", Rgb(1.09f, 1.59f, 1.79f), Rgb(.013f, .070f, .145f)},
    {"Spectralon", Rgb(11.6f, 20.4f, 14.9f), Rgb(0, 0, 0)},
    {"Wholemilk", Rgb(2.55f, 3.21f, 3.77f), Rgb(.0011f, .0024f, .014f)},
    // Narasimhan, Gupta, Donner, Ramamoorthi, Nayar & Jensen 2006, "Acquiring Scattering Properties of
    // Participating Media by Dilution"
    {"Lowfat Milk", Rgb(.89187f, 1.5136f, 2.532f), Rgb(.002875f, .00575f, .0115f)},
    {"Reduced Milk", Rgb(2.4858f, 3.1669f, 4.5214f), Rgb(.0025556f, .0051111f, .012778f)},
    {"Regular Milk", Rgb(4.5513f, 5.8294f, 7.136f), Rgb(.0015333f, .0046f, .019933f)},
    {"Espresso", Rgb(.72378f, .84557f, 1.0247f), Rgb(4.7984f, 6.5751f, 8.8493f)},
    {"Mint Mocha Coffee", Rgb(.31602f, .38538f, .48131f), Rgb(3.772f, 5.8228f, 7.82f)},
    {"Lowfat Soy Milk", Rgb(.30576f, .34233f, .61664f), Rgb(.0014375f, .0071875f, .035937f)},
    {"Regular Soy Milk", Rgb(.59223f, .73866f, 1.4693f), Rgb(.0019167f, .0095833f, .065167f)},
    {"Lowfat Chocolate Milk", Rgb(.64925f, .83916f, 1.1057f), Rgb(.0115f, .0368f, .1564f)},
    {"Regular Chocolate Milk", Rgb(1.4585f, 2.1289f, 2.9527f), Rgb(.010063f, .043125f, .14375f)},
    {"Coke", Rgb(8.9053e-5f, 8.372e-5f, 0), Rgb(.10014f, .16503f, .2468f)},
    {"Pepsi", Rgb(6.1697e-5f, 4.2564e-5f, 0), Rgb(.091641f, .14158f, .20729f)},
    {"Sprite", Rgb(6.0306e-6f, 6.4139e-6f, 6.5504e-6f), Rgb(.001886f, .0018308f, .0020025f)},
    {"Gatorade", Rgb(.0024574f, .003007f, .0037325f), Rgb(.024794f, .019289f, .008878f)},
    {"Chardonnay", Rgb(1.7982e-5f, 1.3758e-5f, 1.2023e-5f), Rgb(.010782f, .011855f, .023997f)},
    {"White Zinfandel", Rgb(1.7501e-5f, 1.9069e-5f, 1.288e-5f), Rgb(.012072f, .016184f, .019843f)},
    {"Merlot", Rgb(2.1129e-5f, 0, 0), Rgb(.11632f, .25191f, .29434f)},
    {"Budweiser Beer", Rgb(2.4356e-5f, 2.4079e-5f, 1.0564e-5f), Rgb(.011492f, .024911f, .057786f)},
    {"Coors Light Beer", Rgb(5.0922e-5f, 4.301e-5f, 0), Rgb(.006164f, .013984f, .034983f)},
    {"Clorox", Rgb(.0024035f, .0031373f, .003991f), Rgb(.0033542f, .014892f, .026297f)},
    {"Apple Juice", Rgb(.00013612f, .00015836f, .000227f), Rgb(.012957f, .023741f, .052184f)},
    {"Cranberry Juice", Rgb(.00010402f, .00011646f, 7.8139e-5f), Rgb(.039437f, .094223f, .12426f)},
    {"Grape Juice", Rgb(5.382e-5f, 0, 0), Rgb(.10404f, .23958f, .29325f)},
    {"Ruby Grapefruit Juice", Rgb(.011002f, .010927f, .011036f), Rgb(.085867f, .18314f, .25262f)},
    {"White Grapefruit Juice", Rgb(.22826f, .23998f, .32748f), Rgb(.0138f, .018831f, .056781f)},
    {"Shampoo", Rgb(.0007176f, .0008303f, .0009016f), Rgb(.014107f, .045693f, .061717f)},
    {"Strawberry Shampoo", Rgb(.00015671f, .00015947f, 1.518e-5f), Rgb(.01449f, .05796f, .075823f)},
    {"Head & Shoulders Shampoo", Rgb(.023805f, .028804f, .034306f), Rgb(.084621f, .15688f, .20365f)},
    {"Lemon Tea Powder", Rgb(.040224f, .045264f, .051081f), Rgb(2.4288f, 4.5757f, 7.2127f)},
    {"Orange Powder", Rgb(.00015617f, .00017482f, .0001762f), Rgb(.001449f, .003441f, .007863f)},
    {"Pink Lemonade Powder", Rgb(.00012103f, .00013073f, .00012528f), Rgb(.001165f, .002366f, .003195f)},
    {"Cappuccino Powder", Rgb(1.8436f, 2.5851f, 2.1662f), Rgb(35.844f, 49.547f, 61.084f)},
    {"Salt Powder", Rgb(.027333f, .032451f, .031979f), Rgb(.28415f, .3257f, .34148f)},
    {"Sugar Powder", Rgb(.00022272f, .00025513f, .000271f), Rgb(.012638f, .031051f, .050124f)},
    {"Suisse Mocha Powder", Rgb(2.7979f, 3.5452f, 4.3365f), Rgb(17.502f, 27.004f, 35.433f)},
    {"Pacific Ocean Surface Water", Rgb(.0001764f, .00032095f, .00019617f),
     Rgb(.031845f, .031324f, .030147f)},
}};

}  // namespace

std::optional<MediumPreset> findPreset(std::string_view name) {
  const auto found = std::find_if(kPresets.begin(), kPresets.end(),
                                  [name](const MediumPreset& preset) { return preset.name == name; });
  if (found == kPresets.end()) return std::nullopt;
  return *found;
}

std::span<const MediumPreset> mediumPresets() { return kPresets; }

}  // namespace pbrtmedia
